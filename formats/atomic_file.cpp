#include "formats/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <tuple>
#include <utility>

#include "formats/error.h"
#include "formats/file_names.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;

// Returns where a chain of symbolic links ends; that file need not exist.
fs::path follow_links(const fs::path& path) {
  constexpr int max_links = 40;  // as the kernel
  fs::path end = path;
  for (int links = 0; links <= max_links; ++links) {
    std::error_code error;
    const fs::path next = fs::read_symlink(end, error);
    if (error) return end;
    end = next.is_absolute() ? next : end.parent_path() / next;
  }
  errno = ELOOP;
  throw_system_error(path, "cannot be written");
}

enum class Target { file, stream };  // a file is replaced, a device or FIFO is written into

Target classify_target(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return Target::file;
  const char* refusal = S_ISDIR(status.st_mode)    ? "it is a folder"
                        : S_ISBLK(status.st_mode)  ? "it is a block device"
                        : S_ISSOCK(status.st_mode) ? "it is a socket"
                                                   : nullptr;
  if (refusal) throw Error(path.string(), std::string("cannot be written: ") + refusal);
  if (::access(path.c_str(), W_OK) != 0) throw_system_error(path, "cannot be written");
  return Target::stream;
}

// Returns -1 where the file system, or a system without /proc, has no files that get their names
// later.
int open_nameless(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, file_mode);
  if (descriptor < 0) return -1;
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  if (::access(link.c_str(), F_OK) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

// O_NOCTTY: a terminal must not become the one whose Ctrl-C ends us. Opening a FIFO waits for its
// reader.
void write_into_stream(std::FILE* source, const fs::path& path) {
  FilePointer stream;
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) throw_system_error(path, "cannot be written");
  stream.reset(::fdopen(descriptor, "wb"));
  if (!stream) {
    ::close(descriptor);
    throw_system_error(path, "cannot be written");
  }
  std::rewind(source);
  read_blocks(source, path, [&](const char* bytes, std::size_t size) {
    if (!write_bytes(stream.get(), bytes, size)) throw_system_error(path, "cannot be written");
  });
  if (std::fflush(stream.get()) != 0) throw_system_error(path, "cannot be written");
}

void replace(const fs::path& scratch, const fs::path& target, const fs::path& path) {
  if (::rename(scratch.c_str(), target.c_str()) != 0) throw_system_error(path, "cannot be written");
  sync_folder(folder_of(target));
}

}  // namespace

void copy_file(const fs::path& source, AtomicFile& target) {
  const FilePointer file(std::fopen(source.c_str(), "rbe"));
  if (!file) throw_system_error(source, "cannot be read");
  read_blocks(file.get(), source,
              [&](const char* bytes, std::size_t size) { target.write(bytes, size); });
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  is_stream_ = classify_target(path_) == Target::stream;
  target_ = is_stream_ ? path_ : follow_links(path_);
  int descriptor = open_nameless(is_stream_ ? scratch_folder() : folder_of(target_));
  if (descriptor < 0) {
    const SignalHold hold;
    std::tie(scratch_, descriptor) =
        open_hidden_beside(is_stream_ ? scratch_folder() / "stream" : target_);
    if (descriptor < 0) throw_system_error(path_, "cannot be written");
    leftover_ = Leftover(scratch_, Leftover::Kind::file);
  }
  file_ = BufferedStream(descriptor, path_);
}

AtomicFile::~AtomicFile() {
  if (!scratch_.empty()) ::unlink(scratch_.c_str());
}

void AtomicFile::fail_write() {
  if (failure_ == 0) failure_ = errno;
  errno = failure_;
  throw_system_error(path_, "cannot be written");
}

void AtomicFile::write(const void* bytes, std::size_t size) {
  if (!write_bytes(file_.get(), bytes, size)) fail_write();
  size_ += size;
}

void AtomicFile::write_at(std::uint64_t offset, const void* bytes, std::size_t size) {
  if (offset + size > size_) throw Error(path_.string(), "write_at beyond the end");
  if (::fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0 ||
      !write_bytes(file_.get(), bytes, size) || ::fseeko(file_.get(), 0, SEEK_END) != 0)
    fail_write();
}

void AtomicFile::commit() {
  if (failure_ != 0 || std::fflush(file_.get()) != 0) fail_write();
  if (is_stream_) {
    write_into_stream(file_.get(), path_);
    file_.reset();
    return;
  }
  if (::fsync(::fileno(file_.get())) != 0) throw_system_error(path_, "cannot be written");
  const SignalHold hold;  // between the hidden name and the real one
  if (scratch_.empty()) {
    const std::string link = "/proc/self/fd/" + std::to_string(::fileno(file_.get()));
    const auto give_name = [&](const fs::path& name) {
      return ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
    };
    scratch_ = make_hidden_beside(target_, give_name).first;
    if (scratch_.empty()) throw_system_error(path_, "cannot be written");
  }
  replace(scratch_, target_, path_);
  scratch_.clear();
  file_.reset();
}

AtomicPath::AtomicPath(fs::path target) : path_(std::move(target)) {
  is_stream_ = classify_target(path_) == Target::stream;
  target_ = is_stream_ ? scratch_folder() / path_.filename() : follow_links(path_);
  const SignalHold hold;
  int descriptor = -1;
  std::tie(scratch_, descriptor) = open_hidden_beside(target_);
  if (descriptor < 0) throw_system_error(path_, "cannot be written");
  ::close(descriptor);
  leftover_ = Leftover(scratch_, Leftover::Kind::file);
}

AtomicPath::~AtomicPath() {
  if (!is_committed_) ::unlink(scratch_.c_str());
}

void AtomicPath::commit() {
  const FilePointer file(std::fopen(scratch_.c_str(), "rbe"));
  if (!file) throw_system_error(path_, "cannot be written");
  if (is_stream_) return write_into_stream(file.get(), path_);
  if (::fsync(::fileno(file.get())) != 0) throw_system_error(path_, "cannot be written");
  replace(scratch_, target_, path_);
  is_committed_ = true;
}

}  // namespace nightcity
