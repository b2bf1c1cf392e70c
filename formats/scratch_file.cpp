#include "formats/scratch_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <tuple>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/file_names.h"

namespace nightcity {

ScratchFile::ScratchFile(const std::filesystem::path& path) : path_(path) {
  // Beside a device there may be no room, and no business, for our files.
  std::error_code ignored;
  const bool is_beside =
      !std::filesystem::exists(path, ignored) || std::filesystem::is_regular_file(path, ignored);
  const std::filesystem::path folder = is_beside ? folder_of(path) : scratch_folder();
  int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    std::filesystem::path name;
    std::tie(name, descriptor) = open_hidden_beside(folder / path.filename());
    if (descriptor < 0) throw_system_error(path, "cannot be written");
    ::unlink(name.c_str());
  }
  file_ = BufferedStream(descriptor, path);
}

void ScratchFile::write(const void* bytes, std::size_t size) {
  if (!write_bytes(file_.get(), bytes, size)) throw_system_error(path_, "cannot be written");
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
    throw_system_error(path_, "cannot be written");
  std::vector<char> buffer(copy_size);
  for (std::uint64_t left = size_; left > 0;) {
    const std::size_t wanted =
        static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer.size()));
    if (std::fread(buffer.data(), 1, wanted, file_.get()) != wanted)
      throw_system_error(path_, "scratch file cannot be read");
    target.write(buffer.data(), wanted);
    left -= wanted;
  }
  if (::fseeko(file_.get(), 0, SEEK_END) != 0) throw_system_error(path_, "cannot be written");
}

void ScratchFile::flush() {
  if (!unflushed_) return;
  if (std::fflush(file_.get()) != 0) throw_system_error(path_, "cannot be written");
  unflushed_ = false;
}

void ScratchFile::read(std::uint64_t offset, void* bytes, std::size_t size) {
  // pread leaves the writing position alone; what the stream still holds must reach the file first.
  flush();
  for (std::size_t done = 0; done < size;) {
    const ssize_t got = ::pread(::fileno(file_.get()), static_cast<char*>(bytes) + done,
                                size - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw_system_error(path_, "scratch file cannot be read");
    done += static_cast<std::size_t>(got);
  }
}

std::filesystem::path ScratchFile::path_while_open() const {
  return "/proc/self/fd/" + std::to_string(::fileno(file_.get()));
}

void ScratchFile::copy_to(AtomicFile& target) {
  copy(target);
}
void ScratchFile::copy_to(ScratchFile& target) {
  copy(target);
}

}  // namespace nightcity
