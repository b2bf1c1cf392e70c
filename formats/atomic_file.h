// Files that appear under their names whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "formats/buffered_stream.h"
#include "formats/signals.h"

namespace nightcity {

/// A file that appears under its name when commit() is called, and not at all when it is destroyed
/// before that.
///
/// Until then its bytes lie in a file without a name in the same folder, so that not even a kill
/// leaves anything behind. (Where the file system has no such files, in ".NAME.XXXXXX.part", which
/// signals remove as well.) commit() waits until the disk has them before it gives them the name,
/// so a power cut leaves the old file or the new one, whole.
///
/// A symbolic link stays, and the file that it points to is replaced. A character device or FIFO
/// gets the bytes written into it, by commit(). A folder, a block device or a socket is refused.
/// All functions throw Error with the file's name and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Overwrites bytes already written (a header whose figures are known last), then goes on at the
  /// end.
  void write_at(std::uint64_t offset, const void* bytes, std::size_t size);
  std::uint64_t size() const { return size_; }
  /// Throws again where an earlier write has failed: a library in between may have swallowed that.
  void commit();

 private:
  [[noreturn]] void fail_write();

  std::filesystem::path path_;     // as the caller named it, for messages
  std::filesystem::path target_;   // where links lead to
  std::filesystem::path scratch_;  // empty: the file has no name yet
  Leftover leftover_;
  bool is_stream_ = false;  // the target is a device or FIFO
  BufferedStream file_;
  std::uint64_t size_ = 0;
  int failure_ = 0;  // errno of the first write that failed
};

/// The same for a library that opens its output by name: an empty file ".NAME.XXXXXX.part" of our
/// own, that commit() turns into the target. Same promises, but a kill leaves the hidden file
/// behind.
class AtomicPath {
 public:
  explicit AtomicPath(std::filesystem::path target);
  AtomicPath(const AtomicPath&) = delete;
  AtomicPath& operator=(const AtomicPath&) = delete;
  ~AtomicPath();

  const std::filesystem::path& scratch() const { return scratch_; }
  void commit();

 private:
  std::filesystem::path path_, target_, scratch_;
  Leftover leftover_;
  bool is_stream_ = false, is_committed_ = false;
};

/// Appends the bytes of `source` to `target`.
void copy_file(const std::filesystem::path& source, AtomicFile& target);

}  // namespace nightcity
