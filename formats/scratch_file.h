// Bytes on disk that no file's name leads to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "formats/buffered_stream.h"

namespace nightcity {

class AtomicFile;

/// Bytes kept out of memory until they are wanted: a file without a name in the folder of `path`,
/// so that nothing can be left behind even when the program is killed.
class ScratchFile {
 public:
  explicit ScratchFile(const std::filesystem::path& path);

  void write(const void* bytes, std::size_t size);
  /// Zero bytes up to the next multiple of `alignment`.
  void align(std::size_t alignment);
  std::uint64_t size() const { return size_; }
  /// Writes what is buffered to the file. Until the next write, many threads may then read.
  void flush();
  void read(std::uint64_t offset, void* bytes, std::size_t size);
  /// Returns a path by which this process may open the bytes for reading as long as this object is
  /// there: for libraries that take names alone.
  std::filesystem::path path_while_open() const;
  void copy_to(AtomicFile& target);
  void copy_to(ScratchFile& target);

 private:
  template <class Target>
  void copy(Target& target);

  std::filesystem::path path_;
  BufferedStream file_;
  std::uint64_t size_ = 0;
  bool unflushed_ = false;
};

}  // namespace nightcity
