// A file that appears under its name whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace nightcity {

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

/// Written beside `path` as ".NAME.XXXXXX.part" and renamed by commit(); removed when destroyed before that.
/// All functions throw Error with the file's name and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Overwrites bytes already written (a header whose figures are known last), then goes on at the end.
  void write_at(std::uint64_t offset, const void* bytes, std::size_t size);
  std::uint64_t size() const { return size_; }
  void commit();

 private:
  std::filesystem::path path_, scratch_path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_ = 0;
};

/// Bytes kept out of memory until they are wanted: a file beside `path` that has no name, so that nothing can
/// be left behind even when the program is killed.
class ScratchFile {
 public:
  explicit ScratchFile(const std::filesystem::path& path);

  void write(const void* bytes, std::size_t size);
  /// Zero bytes up to the next multiple of `alignment`.
  void align(std::size_t alignment);
  std::uint64_t size() const { return size_; }
  /// What has been written reaches the file: from then on, until the next write, many threads may read.
  void flush();
  void read(std::uint64_t offset, void* bytes, std::size_t size);
  void copy_to(AtomicFile& target);
  void copy_to(ScratchFile& target);

 private:
  template <class Target>
  void copy(Target& target);

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_ = 0;
  bool unflushed_ = false;
};

}  // namespace nightcity
