#include "tools/bake/output_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/file_names.h"

namespace nightcity::bake {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view staging_prefix = ".nightbake-";
constexpr const char* staging_suffix = "XXXXXX";
// In a hidden folder: the names to move out, one a line. All files are whole once it is there.
constexpr const char* journal_name = "commit";
constexpr const char* old_files = "old";

class Descriptor {
 public:
  explicit Descriptor(const fs::path& folder, int flags = 0)
      : value_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | flags)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int release() { return std::exchange(value_, -1); }
  bool lock() const { return value_ >= 0 && ::flock(value_, LOCK_EX | LOCK_NB) == 0; }

 private:
  int value_;
};

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw Error(to.string(), "cannot be written: " + error.message());
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

// Moves those of `names` that are in `staging` out into `folder`, the first last. An error undoes
// what was done.
void move_out(const fs::path& staging, const fs::path& folder, const std::vector<fs::path>& names) {
  std::vector<std::pair<fs::path, fs::path>> done;  // from, to
  const auto move_on = [&done](const fs::path& from, const fs::path& to) {
    move(from, to);
    done.emplace_back(from, to);
  };
  const fs::path old = staging / old_files;
  std::vector<fs::path> made;
  std::error_code ignored;
  // The absence of a folder shows in the first move into it.
  fs::create_directory(old, ignored);
  for (const fs::path& name : names) {
    if (!name.has_parent_path()) continue;
    fs::create_directory(old / name.parent_path(), ignored);
    if (fs::create_directory(folder / name.parent_path(), ignored))
      made.push_back(folder / name.parent_path());
  }
  try {
    for (const fs::path& name : names)
      if (is_there(staging / name) && is_there(folder / name)) move_on(folder / name, old / name);
    std::for_each(names.rbegin(), names.rend(), [&](const fs::path& name) {
      if (is_there(staging / name)) move_on(staging / name, folder / name);
    });
  } catch (const Error&) {
    std::for_each(done.rbegin(), done.rend(),
                  [&](const auto& pair) { fs::rename(pair.second, pair.first, ignored); });
    for (const fs::path& level : made) ::rmdir(level.c_str());
    throw;
  }
  for (const fs::path& level : made) sync_folder(level);
  sync_folder(folder);
}

// A file's name, or that of one in a folder: what a journal of ours may hold.
bool stays_below(const fs::path& name) {
  return name.has_filename() && name.is_relative() &&
         std::distance(name.begin(), name.end()) <= 2 &&
         std::none_of(name.begin(), name.end(),
                      [](const fs::path& part) { return part == "." || part == ".."; });
}

std::vector<fs::path> read_journal(const fs::path& staging) {
  std::vector<fs::path> names;
  std::ifstream journal(staging / journal_name);
  for (std::string line; std::getline(journal, line);)
    if (stays_below(line)) names.emplace_back(line);
  return names;
}

void write_journal(const fs::path& staging, const std::vector<fs::path>& names) {
  AtomicFile journal(staging / journal_name);
  for (const fs::path& name : names) journal.write(name.string() + "\n");
  journal.commit();
}

bool is_staging_of_ours(const fs::path& path) {
  const std::string name = path.filename().string();
  struct stat status {};
  return name.starts_with(staging_prefix) &&
         name.size() == staging_prefix.size() + std::strlen(staging_suffix) &&
         ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         status.st_uid == ::geteuid();
}

// Finishes and removes what bakes that were killed have left in `folder`. Best effort: a file
// system without locks keeps it.
void remove_abandoned(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> abandoned;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (is_staging_of_ours(entry->path())) abandoned.push_back(entry->path());
  for (const fs::path& staging : abandoned) {
    const Descriptor descriptor(staging, O_NOFOLLOW);
    if (!descriptor.lock()) continue;  // another bake is at work in it
    try {
      move_out(staging, folder, read_journal(staging));
    } catch (const Error&) {
      continue;  // its files may be all there is of that city
    }
    fs::remove_all(staging, error);
  }
}

// Waits for other bakes, which hold this lock for milliseconds, and not for whoever locks the
// folder for reasons of his own.
bool lock_soon(const Descriptor& folder) {
  using namespace std::chrono_literals;
  for (int attempt = 0; attempt < 100; ++attempt, std::this_thread::sleep_for(10ms))
    if (folder.lock()) return true;
  return false;
}

// A name that cannot be moved onto: what it stands for lies elsewhere.
bool leads_elsewhere(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)) {
  if (folder_.empty()) folder_ = ".";
  folder_ = fs::absolute(folder_).lexically_normal();
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  const SignalHold hold;  // until all that is made is registered
  try {
    make_folder();
    make_staging();
  } catch (...) {
    remove_made();
    throw;
  }
}

void OutputFolder::make_folder() {
  std::vector<fs::path> missing;
  for (fs::path level = folder_; !is_there(level) && level.has_relative_path();
       level = level.parent_path())
    missing.push_back(level);
  for (auto level = missing.rbegin(); level != missing.rend(); ++level) {
    if (::mkdir(level->c_str(), 0777) == 0) {
      leftovers_.emplace_back(*level, Leftover::Kind::folder);
      made_.push_back(*level);
    } else if (errno != EEXIST) {  // another program may have been faster
      throw Error(folder_.string(), std::string("cannot be made: ") + std::strerror(errno));
    }
  }
  std::error_code error;
  if (!fs::is_directory(folder_, error))
    throw Error(folder_.string(), error ? "cannot be made: " + error.message() : "is no folder");
}

void OutputFolder::make_staging() {
  // Between its making and its lock the hidden folder looks abandoned. Whoever removes abandoned
  // ones holds this lock.
  const Descriptor parent(folder_);
  if (lock_soon(parent)) remove_abandoned(folder_);
  std::string name = (folder_ / staging_prefix).string() + staging_suffix;
  if (!::mkdtemp(name.data()))
    throw Error(folder_.string(), std::string("cannot be written into: ") + std::strerror(errno));
  staging_ = name;
  leftovers_.emplace_back(staging_, Leftover::Kind::tree);
  Descriptor staging(staging_);
  if (staging.lock()) lock_ = staging.release();
}

void OutputFolder::remove_made() noexcept {
  // rmdir refuses a folder that holds anything: it may be another's by now.
  std::for_each(made_.rbegin(), made_.rend(),
                [](const fs::path& level) { ::rmdir(level.c_str()); });
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (lock_ >= 0) ::close(lock_);
  remove_made();
}

fs::path OutputFolder::staged(const fs::path& name) {
  std::error_code ignored;  // its absence shows where the file is opened
  if (name.has_parent_path()) fs::create_directory(staging_ / name.parent_path(), ignored);
  names_.push_back(name);
  return staging_ / name;
}

void OutputFolder::commit() {
  // Every target is looked at before the first is replaced: a folder in the way must not leave half
  // a scene.
  std::vector<fs::path> moved;
  std::vector<std::unique_ptr<AtomicFile>> copied;
  for (const fs::path& name : names_) {
    if (leads_elsewhere(folder_ / name)) {
      copied.push_back(std::make_unique<AtomicFile>(folder_ / name));
      copy_file(staging_ / name, *copied.back());
    } else {
      moved.push_back(name);
    }
  }
  const SignalHold hold;
  std::for_each(copied.rbegin(), copied.rend(), [](auto& file) { file->commit(); });
  write_journal(staging_, moved);
  try {
    move_out(staging_, folder_, moved);
  } catch (const Error&) {
    ::unlink((staging_ / journal_name).c_str());
    throw;
  }
  made_.clear();
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

}  // namespace nightcity::bake
