#include "tools/city/zip_archive.h"

#include <zip.h>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/file_names.h"
#include "formats/scratch_file.h"
#include "formats/to_lower.h"
#include "tools/city/file_stamp.h"
#include "tools/city/unpacked_size.h"

namespace nightcity::city {
namespace {

struct ZipDeleter {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

[[noreturn]] void refuse_broken(const std::string& name) {
  throw Error(name, "broken zip archive: damaged or cut off; fetch it again");
}

// Archives made on a Mac hold "__MACOSX/._name" for each file, with icons and the like in it.
bool is_hidden_entry(std::string_view entry) {
  const std::size_t slash = entry.rfind('/');
  const std::string_view name = slash == entry.npos ? entry : entry.substr(slash + 1);
  return name.starts_with('.') || entry.starts_with("__MACOSX/");
}

}  // namespace

// An archive, opened once for all of its entries: opening reads the list of them, so that opening
// for each entry anew would take time quadratic in their number. libzip's handles are for one
// thread at a time.
class ZipArchive {
 public:
  explicit ZipArchive(const std::string& path)
      : size_(find_packed_size(path)), archive_(zip_open(path.c_str(), ZIP_RDONLY, nullptr)) {
    if (!archive_) refuse_broken(path);
  }
  ZipArchive(std::unique_ptr<ScratchFile> unpacked, const std::string& name)
      : unpacked_(std::move(unpacked)),
        size_(unpacked_->size()),
        archive_(zip_open(unpacked_->path_while_open().c_str(), ZIP_RDONLY, nullptr)) {
    if (!archive_) refuse_broken(name);
  }

  zip_t* get() const { return archive_.get(); }
  // Returns whether it lies in another archive.
  bool is_inner() const { return unpacked_ != nullptr; }
  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }
  std::uint64_t packed_size(zip_uint64_t index) {
    const auto held = lock();
    zip_stat_t status;
    zip_stat_init(&status);
    const bool known = zip_stat_index(get(), index, 0, &status) == 0;
    // No entry is larger than the archive, whatever it says.
    return known && (status.valid & ZIP_STAT_COMP_SIZE) ? std::min(status.comp_size, size_) : 0;
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<ScratchFile> unpacked_;
  std::uint64_t size_;
  std::unique_ptr<zip_t, ZipDeleter> archive_;
};

namespace {

class ZipSource : public ByteSource {
 public:
  ZipSource(std::shared_ptr<ZipArchive> archive, zip_uint64_t index, std::string name)
      : archive_(std::move(archive)),
        name_(std::move(name)),
        unpacked_(name_, archive_->packed_size(index)) {
    const auto lock = archive_->lock();
    entry_.reset(zip_fopen_index(archive_->get(), index, 0));
    if (!entry_ && zip_error_code_zip(zip_get_error(archive_->get())) == ZIP_ER_NOPASSWD)
      throw Error(name_, "is encrypted with a password: unpack it first");
    if (!entry_)
      throw Error(name_,
                  std::string("cannot open the archive's entry: ") + zip_strerror(archive_->get()));
  }
  ~ZipSource() override {
    const auto lock = archive_->lock();
    entry_.reset();
  }
  ZipSource(const ZipSource&) = delete;
  ZipSource& operator=(const ZipSource&) = delete;

  std::size_t read(char* out, std::size_t size) override {
    const auto lock = archive_->lock();
    const zip_int64_t got = zip_fread(entry_.get(), out, size);
    if (got < 0) throw Error(name_, "broken archive entry");
    unpacked_.add(static_cast<std::size_t>(got));
    return static_cast<std::size_t>(got);
  }

 private:
  std::shared_ptr<ZipArchive> archive_;
  std::unique_ptr<zip_file_t, ZipDeleter> entry_;
  std::string name_;
  UnpackedSize unpacked_;
};

std::vector<ZipEntry> list_one(const std::shared_ptr<ZipArchive>& archive,
                               const std::string& in_front) {
  std::vector<ZipEntry> entries;
  const zip_int64_t count = zip_get_num_entries(archive->get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* name = zip_get_name(archive->get(), index, ZIP_FL_ENC_GUESS);
    if (name && !is_hidden_entry(name) && !std::string_view(name).ends_with('/'))
      entries.push_back({in_front + name, archive, index});
  }
  return entries;
}

// Returns the archive that an entry is; null where it is only named like one.
std::shared_ptr<ZipArchive> unpack_archive(const ZipEntry& entry, const std::string& name,
                                           UnpackedSize& unpacked) {
  constexpr std::size_t block = std::size_t{1} << 16;
  if (!to_lower(entry.inside).ends_with(".zip")) return nullptr;
  const auto source = entry.open(name);
  auto file = std::make_unique<ScratchFile>(scratch_folder() / "archive");
  for (std::string bytes = read_next(*source, block); !bytes.empty();
       bytes = read_next(*source, block)) {
    if (file->size() == 0 && !bytes.starts_with(zip_mark)) return nullptr;
    unpacked.add(bytes.size());
    file->write(bytes.data(), bytes.size());
  }
  file->flush();
  return file->size() > 0 ? std::make_shared<ZipArchive>(std::move(file), name) : nullptr;
}

std::vector<ZipEntry> list_with_inner_archives(const std::string& path) {
  UnpackedSize unpacked(path, find_packed_size(path));
  std::vector<ZipEntry> entries;
  for (ZipEntry& entry : list_one(std::make_shared<ZipArchive>(path), {})) {
    const auto inner = unpack_archive(entry, path + "/" + entry.inside, unpacked);
    if (!inner)
      entries.push_back(std::move(entry));
    else
      for (ZipEntry& one : list_one(inner, entry.inside + "/")) entries.push_back(std::move(one));
  }
  return entries;
}

}  // namespace

bool is_zip(const std::filesystem::path& file) {
  std::error_code ignored;  // the readers say what is wrong with a file
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  std::string bytes(zip_mark.size(), '\0');
  std::ifstream(file, std::ios::binary)
      .read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return bytes == zip_mark;
}

std::uint64_t ZipEntry::packed_size() const {
  return archive->packed_size(index);
}

std::unique_ptr<ByteSource> ZipEntry::open(const std::string& name) const {
  return std::make_unique<ZipSource>(archive, index, name);
}

std::vector<ZipEntry> list_zip_entries(const std::string& path) {
  static LastOfFiles<std::vector<ZipEntry>> last;
  const auto holds_archives = [](const std::vector<ZipEntry>& entries) {
    return std::any_of(entries.begin(), entries.end(),
                       [](const ZipEntry& entry) { return entry.archive->is_inner(); });
  };
  return last.find(
      path, [&] { return list_with_inner_archives(path); }, holds_archives);
}

}  // namespace nightcity::city
