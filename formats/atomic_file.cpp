#include "formats/atomic_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "formats/error.h"

namespace nightcity {
namespace {

constexpr std::size_t copy_size = 1 << 20;

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw Error(path.string(), std::string(what) + ": " + std::strerror(errno));
}

// mkstemp beside the target: the same file system, so that rename is atomic.
std::unique_ptr<std::FILE, CloseFile> create_beside(const std::filesystem::path& path,
                                                    std::string& name) {
  name = (path.parent_path() / ".").string();
  name += path.filename().string();
  name += ".XXXXXX.part";
  const int descriptor = ::mkstemps(name.data(), 5);
  if (descriptor < 0) fail(path, "cannot be written");
  std::unique_ptr<std::FILE, CloseFile> file(::fdopen(descriptor, "w+b"));
  if (!file) {
    ::close(descriptor);
    ::unlink(name.c_str());
    fail(path, "cannot be written");
  }
  return file;
}

void put(const std::filesystem::path& path, std::FILE* file, const void* bytes, std::size_t size) {
  if (size != 0 && std::fwrite(bytes, 1, size, file) != size) fail(path, "cannot be written");
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  if (std::error_code ignored; std::filesystem::is_directory(path_, ignored))
    throw Error(path_.string(), "cannot be written: it is a folder");
  std::string name;
  file_ = create_beside(path_, name);
  scratch_path_ = name;
}

AtomicFile::~AtomicFile() {
  if (file_) ::unlink(scratch_path_.c_str());
}

void AtomicFile::write(const void* bytes, std::size_t size) {
  put(path_, file_.get(), bytes, size);
  size_ += size;
}

void AtomicFile::write_at(std::uint64_t offset, const void* bytes, std::size_t size) {
  if (offset + size > size_) throw Error(path_.string(), "write_at beyond the end");
  if (::fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) != 0)
    fail(path_, "cannot be written");
  put(path_, file_.get(), bytes, size);
  if (::fseeko(file_.get(), 0, SEEK_END) != 0) fail(path_, "cannot be written");
}

void AtomicFile::commit() {
  // mkstemp makes files nobody else may read; a city is an ordinary file, under the user's mask.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const bool written =
      std::fflush(file_.get()) == 0 && ::fchmod(::fileno(file_.get()), 0666 & ~mask) == 0;
  if (!written) fail(path_, "cannot be written");
  if (::rename(scratch_path_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be written");
  file_.reset();
}

ScratchFile::ScratchFile(const std::filesystem::path& path) : path_(path) {
  std::string name;
  file_ = create_beside(path, name);
  ::unlink(name.c_str());
}

void ScratchFile::write(const void* bytes, std::size_t size) {
  put(path_, file_.get(), bytes, size);
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
  flush();  // pread leaves the writing position alone; what the stream still holds must reach the file first
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
