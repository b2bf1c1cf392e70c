// Open files: streams with large buffers, blocks of bytes, and errors with the system's reason.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace nightcity {

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

/// An open file with a large buffer of its own.
class BufferedStream {
 public:
  BufferedStream() = default;
  /// Takes the descriptor; `path` is for messages.
  BufferedStream(int descriptor, const std::filesystem::path& path);
  std::FILE* get() const { return file_.get(); }
  void reset() { file_.reset(); }

 private:
  struct FreeBuffer {
    void operator()(char* buffer) const noexcept;
  };
  std::unique_ptr<char, FreeBuffer> buffer_;  // first: closing the file writes what it holds
  std::unique_ptr<std::FILE, CloseFile> file_;
};

/// Throws Error with the file's name, `what`, and the reason that errno names.
[[noreturn]] void throw_system_error(const std::filesystem::path& path, const char* what);

/// Returns whether all bytes were written.
bool write_bytes(std::FILE* file, const void* bytes, std::size_t size);

/// Bytes that are copied at once.
constexpr std::size_t copy_size = 1 << 20;

/// Gives `sink` what is left of `source`, block by block. Throws Error where that cannot be read.
template <class Sink>
void read_blocks(std::FILE* source, const std::filesystem::path& path, const Sink& sink) {
  std::vector<char> buffer(copy_size);
  for (;;) {
    const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), source);
    if (got > 0) sink(buffer.data(), got);
    if (got < buffer.size()) break;
  }
  if (std::ferror(source)) throw_system_error(path, "cannot be read");
}

}  // namespace nightcity
