#include "formats/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "formats/error.h"

namespace nightcity {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const int descriptor =
      ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a FIFO must not keep us waiting
  if (descriptor < 0)
    throw Error(path.string(), std::string("cannot be read: ") + std::strerror(errno));
  struct stat status {};
  const bool known = ::fstat(descriptor, &status) == 0;
  const char* refusal = !known                     ? "cannot be read"
                        : S_ISDIR(status.st_mode)  ? "is a folder, not a file"
                        : !S_ISREG(status.st_mode) ? "is not a regular file"
                                                   : nullptr;
  if (refusal) {
    ::close(descriptor);
    throw Error(path.string(), refusal);
  }
  const std::size_t size = static_cast<std::size_t>(status.st_size);
  void* memory = size == 0 ? nullptr : ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int mapping_error = errno;
  ::close(descriptor);
  if (memory == MAP_FAILED)
    throw Error(path.string(), std::string("cannot be mapped: ") + std::strerror(mapping_error));
  bytes_ = {static_cast<const std::byte*>(memory), size};
  if (size != 0) range_ = MappedRange(bytes_, path);
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void MappedFile::release_pages() const {
  if (!bytes_.empty())
    ::madvise(const_cast<std::byte*>(bytes_.data()), bytes_.size(), MADV_DONTNEED);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : bytes_(std::exchange(other.bytes_, {})), range_(std::move(other.range_)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  std::swap(range_, other.range_);
  return *this;
}

}  // namespace nightcity
