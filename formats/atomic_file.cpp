#include "formats/atomic_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/error.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

constexpr std::size_t copy_size = 1 << 20;
constexpr mode_t file_mode = 0666;  // less the user's mask, as any file

[[noreturn]] void fail(const fs::path& path, const char* what) {
  throw Error(path.string(), std::string(what) + ": " + std::strerror(errno));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

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
  fail(path, "cannot be written");
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
  if (::access(path.c_str(), W_OK) != 0) fail(path, "cannot be written");
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

// Calls `make(name)` with hidden names beside `path` until one is free. Returns the name and what
// `make` returned, or an empty name and -1 with errno set.
template <class Make>
std::pair<fs::path, int> make_beside(const fs::path& path, const Make& make) {
  constexpr char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
  constexpr std::size_t max_name = 200;  // a file name has 255 bytes
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string name = "." + path.filename().string().substr(0, max_name) + ".";
    for (int i = 0; i < 6; ++i) name += letters[random() % (sizeof letters - 1)];
    const fs::path result = folder_of(path) / (name + ".part");
    const int made = make(result);
    if (made >= 0) return {result, made};
    if (errno != EEXIST) break;
  }
  return {fs::path(), -1};
}

std::pair<fs::path, int> open_named(const fs::path& target) {
  return make_beside(target, [](const fs::path& name) {
    return ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, file_mode);
  });
}

// A byte costs the system a third of what it costs in writes of 4 kB (ext4 on Linux 6.18).
constexpr std::size_t buffer_size = std::size_t{1} << 16;
// A whole page, because some processors copy slowly to and from addresses just beside one.
constexpr std::align_val_t buffer_alignment{4096};

bool put(std::FILE* file, const void* bytes, std::size_t size) {
  return size == 0 || std::fwrite(bytes, 1, size, file) == size;
}

// Reads what is left of `source`, block by block.
template <class Sink>
void read_blocks(std::FILE* source, const fs::path& path, const Sink& sink) {
  std::vector<char> buffer(copy_size);
  for (;;) {
    const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), source);
    if (got > 0) sink(buffer.data(), got);
    if (got < buffer.size()) break;
  }
  if (std::ferror(source)) fail(path, "cannot be read");
}

// O_NOCTTY: a terminal must not become the one whose Ctrl-C ends us. Opening a FIFO waits for its
// reader.
void write_into_stream(std::FILE* source, const fs::path& path) {
  FilePointer stream;
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) fail(path, "cannot be written");
  stream.reset(::fdopen(descriptor, "wb"));
  if (!stream) {
    ::close(descriptor);
    fail(path, "cannot be written");
  }
  std::rewind(source);
  read_blocks(source, path, [&](const char* bytes, std::size_t size) {
    if (!put(stream.get(), bytes, size)) fail(path, "cannot be written");
  });
  if (std::fflush(stream.get()) != 0) fail(path, "cannot be written");
}

void replace(const fs::path& scratch, const fs::path& target, const fs::path& path) {
  if (::rename(scratch.c_str(), target.c_str()) != 0) fail(path, "cannot be written");
  sync_folder(folder_of(target));
}

}  // namespace

BufferedStream::BufferedStream(int descriptor, const fs::path& path)
    // glibc takes the size of a buffer of its own from the file system, and not from setvbuf.
    : buffer_(static_cast<char*>(::operator new(buffer_size, buffer_alignment))),
      file_(::fdopen(descriptor, "w+b")) {
  if (!file_) ::close(descriptor);
  if (!file_ || std::setvbuf(file_.get(), buffer_.get(), _IOFBF, buffer_size) != 0)
    fail(path, "cannot be written");
}

void BufferedStream::FreeBuffer::operator()(char* buffer) const noexcept {
  ::operator delete(buffer, buffer_alignment);
}

fs::path scratch_folder() {
  const char* named = std::getenv("TMPDIR");
  const fs::path folder = named && *named ? named : "/tmp";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(folder.string(),
                "is no folder that temporary files can be written into; TMPDIR names another");
  return folder;
}

void sync_folder(const fs::path& folder) noexcept {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void copy_file(const fs::path& source, AtomicFile& target) {
  const FilePointer file(std::fopen(source.c_str(), "rbe"));
  if (!file) fail(source, "cannot be read");
  read_blocks(file.get(), source,
              [&](const char* bytes, std::size_t size) { target.write(bytes, size); });
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  is_stream_ = classify_target(path_) == Target::stream;
  target_ = is_stream_ ? path_ : follow_links(path_);
  int descriptor = open_nameless(is_stream_ ? scratch_folder() : folder_of(target_));
  if (descriptor < 0) {
    const SignalHold hold;
    std::tie(scratch_, descriptor) = open_named(is_stream_ ? scratch_folder() / "stream" : target_);
    if (descriptor < 0) fail(path_, "cannot be written");
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
  fail(path_, "cannot be written");
}

void AtomicFile::write(const void* bytes, std::size_t size) {
  if (!put(file_.get(), bytes, size)) fail_write();
  size_ += size;
}

void AtomicFile::write_at(std::uint64_t offset, const void* bytes, std::size_t size) {
  if (offset + size > size_) throw Error(path_.string(), "write_at beyond the end");
  if (::fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0 ||
      !put(file_.get(), bytes, size) || ::fseeko(file_.get(), 0, SEEK_END) != 0)
    fail_write();
}

void AtomicFile::commit() {
  if (failure_ != 0 || std::fflush(file_.get()) != 0) fail_write();
  if (is_stream_) {
    write_into_stream(file_.get(), path_);
    file_.reset();
    return;
  }
  if (::fsync(::fileno(file_.get())) != 0) fail(path_, "cannot be written");
  const SignalHold hold;  // between the hidden name and the real one
  if (scratch_.empty()) {
    const std::string link = "/proc/self/fd/" + std::to_string(::fileno(file_.get()));
    const auto give_name = [&](const fs::path& name) {
      return ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
    };
    scratch_ = make_beside(target_, give_name).first;
    if (scratch_.empty()) fail(path_, "cannot be written");
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
  std::tie(scratch_, descriptor) = open_named(target_);
  if (descriptor < 0) fail(path_, "cannot be written");
  ::close(descriptor);
  leftover_ = Leftover(scratch_, Leftover::Kind::file);
}

AtomicPath::~AtomicPath() {
  if (!is_committed_) ::unlink(scratch_.c_str());
}

void AtomicPath::commit() {
  const FilePointer file(std::fopen(scratch_.c_str(), "rbe"));
  if (!file) fail(path_, "cannot be written");
  if (is_stream_) return write_into_stream(file.get(), path_);
  if (::fsync(::fileno(file.get())) != 0) fail(path_, "cannot be written");
  replace(scratch_, target_, path_);
  is_committed_ = true;
}

ScratchFile::ScratchFile(const fs::path& path) : path_(path) {
  // Beside a device there may be no room, and no business, for our files.
  std::error_code ignored;
  const bool is_beside = !fs::exists(path, ignored) || fs::is_regular_file(path, ignored);
  const fs::path folder = is_beside ? folder_of(path) : scratch_folder();
  int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    fs::path name;
    std::tie(name, descriptor) = open_named(folder / path.filename());
    if (descriptor < 0) fail(path, "cannot be written");
    ::unlink(name.c_str());
  }
  file_ = BufferedStream(descriptor, path);
}

void ScratchFile::write(const void* bytes, std::size_t size) {
  if (!put(file_.get(), bytes, size)) fail(path_, "cannot be written");
  unflushed_ = true;
  size_ += size;
}

void ScratchFile::align(std::size_t alignment) {
  constexpr std::array<char, 64> zeros{};
  write(zeros.data(), (alignment - size_ % alignment) % alignment);
}

template <class Target>
void ScratchFile::copy(Target& target) {
  if (std::fflush(file_.get()) != 0 || ::fseeko(file_.get(), 0, SEEK_SET) != 0)
    fail(path_, "cannot be written");
  std::vector<char> buffer(copy_size);
  for (std::uint64_t left = size_; left > 0;) {
    const std::size_t wanted =
        static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer.size()));
    if (std::fread(buffer.data(), 1, wanted, file_.get()) != wanted)
      fail(path_, "scratch file cannot be read");
    target.write(buffer.data(), wanted);
    left -= wanted;
  }
  if (::fseeko(file_.get(), 0, SEEK_END) != 0) fail(path_, "cannot be written");
}

void ScratchFile::flush() {
  if (!unflushed_) return;
  if (std::fflush(file_.get()) != 0) fail(path_, "cannot be written");
  unflushed_ = false;
}

void ScratchFile::read(std::uint64_t offset, void* bytes, std::size_t size) {
  // pread leaves the writing position alone; what the stream still holds must reach the file first.
  flush();
  for (std::size_t done = 0; done < size;) {
    const ssize_t got = ::pread(::fileno(file_.get()), static_cast<char*>(bytes) + done,
                                size - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail(path_, "scratch file cannot be read");
    done += static_cast<std::size_t>(got);
  }
}

void ScratchFile::copy_to(AtomicFile& target) {
  copy(target);
}
void ScratchFile::copy_to(ScratchFile& target) {
  copy(target);
}

}  // namespace nightcity
