#include "formats/buffered_stream.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <string>

#include "formats/error.h"

namespace nightcity {
namespace {

// A byte costs the system a third of what it costs in writes of 4 kB (ext4 on Linux 6.18).
constexpr std::size_t buffer_size = std::size_t{1} << 16;
// A whole page, because some processors copy slowly to and from addresses just beside one.
constexpr std::align_val_t buffer_alignment{4096};

}  // namespace

BufferedStream::BufferedStream(int descriptor, const std::filesystem::path& path)
    // glibc takes the size of a buffer of its own from the file system, and not from setvbuf.
    : buffer_(static_cast<char*>(::operator new(buffer_size, buffer_alignment))),
      file_(::fdopen(descriptor, "w+b")) {
  if (!file_) ::close(descriptor);
  if (!file_ || std::setvbuf(file_.get(), buffer_.get(), _IOFBF, buffer_size) != 0)
    throw_system_error(path, "cannot be written");
}

void BufferedStream::FreeBuffer::operator()(char* buffer) const noexcept {
  ::operator delete(buffer, buffer_alignment);
}

void throw_system_error(const std::filesystem::path& path, const char* what) {
  throw Error(path.string(), std::string(what) + ": " + std::strerror(errno));
}

bool write_bytes(std::FILE* file, const void* bytes, std::size_t size) {
  return size == 0 || std::fwrite(bytes, 1, size, file) == size;
}

}  // namespace nightcity
