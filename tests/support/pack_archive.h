// Archives and streams of any kind that tests pack.
#pragma once

#include <archive.h>
#include <archive_entry.h>
#include <gtest/gtest.h>
#include <zlib.h>
#include <clocale>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/pack_zip.h"
#include "support/temp_folder.h"

namespace nightcity::test {

/// The forms that pack_archive() writes, by the endings of names.
inline constexpr std::array<const char*, 14> archive_forms{
    ".zip",     ".tar",    ".tar.gz", ".tar.bz2", ".tar.xz", ".tar.zst", ".tar.lzma",
    ".tar.lz4", ".tar.lz", ".tar.Z",  ".7z",      ".rar",    ".rar5",    ".7z.xz"};
/// The forms that pack_stream() writes.
inline constexpr std::array<const char*, 7> stream_forms{".gz",   ".bz2", ".xz", ".zst",
                                                         ".lzma", ".lz4", ".lz"};

/// Lets libarchive take names as UTF-8 while it is there.
class NamesInUtf8 {
 public:
  NamesInUtf8() : utf8_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(uselocale(utf8_)) {}
  ~NamesInUtf8() {
    uselocale(before_);
    freelocale(utf8_);
  }
  NamesInUtf8(const NamesInUtf8&) = delete;
  NamesInUtf8& operator=(const NamesInUtf8&) = delete;

 private:
  locale_t utf8_, before_;
};

/// Adds the filter to an archive that the ending of a name says.
inline void add_filter(archive* out, std::string_view name) {
  constexpr std::array<std::pair<std::string_view, int>, 8> filters{
      {{".gz", ARCHIVE_FILTER_GZIP},
       {".bz2", ARCHIVE_FILTER_BZIP2},
       {".xz", ARCHIVE_FILTER_XZ},
       {".zst", ARCHIVE_FILTER_ZSTD},
       {".lzma", ARCHIVE_FILTER_LZMA},
       {".lz4", ARCHIVE_FILTER_LZ4},
       {".lz", ARCHIVE_FILTER_LZIP},
       {".Z", ARCHIVE_FILTER_COMPRESS}}};
  for (const auto& [ending, filter] : filters)
    if (name.ends_with(ending)) {
      ASSERT_EQ(archive_write_add_filter(out, filter), ARCHIVE_OK);
      return;
    }
}

/// An archive that is being written.
class ArchiveWriter {
 public:
  /// `format`: ARCHIVE_FORMAT_7ZIP, ARCHIVE_FORMAT_TAR_PAX_INTERCHANGE, ...; the name says what it
  /// is packed by. `options`: of libarchive ("compression=store").
  ArchiveWriter(const std::filesystem::path& path, int format, const char* options = "")
      : out_(archive_write_new()) {
    archive_write_set_format(out_, format);
    EXPECT_EQ(archive_write_set_options(out_, options), ARCHIVE_OK);
    add_filter(out_, path.native());
    EXPECT_EQ(archive_write_open_filename(out_, path.c_str()), ARCHIVE_OK);
  }
  ~ArchiveWriter() {
    const NamesInUtf8 names;
    EXPECT_EQ(archive_write_close(out_), ARCHIVE_OK);
    archive_write_free(out_);
  }
  ArchiveWriter(const ArchiveWriter&) = delete;
  ArchiveWriter& operator=(const ArchiveWriter&) = delete;

  void add(const std::string& name, std::string_view bytes) {
    archive_entry* const entry = begin(name, AE_IFREG);
    archive_entry_set_size(entry, static_cast<la_int64_t>(bytes.size()));
    finish(entry, bytes);
  }
  void add_hard_link(const std::string& name, const std::string& target) {
    archive_entry* const entry = begin(name, AE_IFREG);
    archive_entry_set_hardlink(entry, target.c_str());
    finish(entry, {});
  }
  void add_link(const std::string& name, const std::string& target) {
    archive_entry* const entry = begin(name, AE_IFLNK);
    archive_entry_set_symlink(entry, target.c_str());
    finish(entry, {});
  }
  /// Adds something that is no file: AE_IFDIR, AE_IFCHR, AE_IFIFO.
  void add_other(const std::string& name, unsigned kind) { finish(begin(name, kind), {}); }
  /// Adds a file of `size` bytes that are zeros but for those at `offset`.
  void add_sparse(const std::string& name, la_int64_t size, la_int64_t offset,
                  std::string_view bytes) {
    archive_entry* const entry = begin(name, AE_IFREG);
    archive_entry_set_size(entry, size);
    archive_entry_sparse_add_entry(entry, offset, static_cast<la_int64_t>(bytes.size()));
    const NamesInUtf8 names;
    EXPECT_EQ(archive_write_header(out_, entry), ARCHIVE_OK);
    const std::string zeros(static_cast<std::size_t>(offset), '\0');
    archive_write_data(out_, zeros.data(), zeros.size());
    archive_write_data(out_, bytes.data(), bytes.size());
    archive_entry_free(entry);
  }

 private:
  static archive_entry* begin(const std::string& name, unsigned kind) {
    archive_entry* const entry = archive_entry_new();
    archive_entry_set_pathname(entry, name.c_str());
    archive_entry_set_filetype(entry, kind);
    archive_entry_set_perm(entry, 0644);
    archive_entry_set_size(entry, 0);
    return entry;
  }
  void finish(archive_entry* entry, std::string_view bytes) {
    const NamesInUtf8 names;
    EXPECT_GE(archive_write_header(out_, entry), ARCHIVE_WARN) << archive_error_string(out_);
    EXPECT_EQ(archive_write_data(out_, bytes.data(), bytes.size()),
              static_cast<la_ssize_t>(bytes.size()));
    archive_entry_free(entry);
  }

  archive* out_;
};

/// Returns numbers in bytes, the lowest first: pairs of a number and how many.
inline std::string to_little_endian(std::initializer_list<std::pair<std::uint64_t, int>> numbers) {
  std::string bytes;
  for (const auto& [number, size] : numbers)
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
  return bytes;
}

inline std::uint32_t find_crc32(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

/// Returns a RAR archive of version 4 whose files are stored. `flags`: of its main header, where 1
/// says that it is one of several volumes, and 128 that the headers are encrypted.
inline std::string make_rar4(const ZipFiles& files, unsigned flags = 0, unsigned file_flags = 0) {
  const auto seal = [](const std::string& header) {
    return to_little_endian({{find_crc32(header) & 0xffff, 2}}) + header;
  };
  std::string rar("Rar!\x1A\x07\0", 7);
  rar += seal(to_little_endian({{0x73, 1}, {flags, 2}, {13, 2}, {0, 2}, {0, 4}}));
  for (const auto& [name, bytes] : files)
    rar += seal(to_little_endian({{0x74, 1},
                                  {0x8000 | file_flags, 2},
                                  {32 + name.size(), 2},
                                  {bytes.size(), 4},
                                  {bytes.size(), 4},
                                  {3, 1},
                                  {find_crc32(bytes), 4},
                                  {0, 4},
                                  {20, 1},
                                  {0x30, 1},
                                  {name.size(), 2},
                                  {0100644, 4}}) +
                name) +
           bytes;
  return rar + seal(to_little_endian({{0x7b, 1}, {0x4000, 2}, {7, 2}}));
}

/// Returns the same of version 5. `flags`: of the archive, where 1 says that it is a volume.
/// `method`: 0 stores.
inline std::string make_rar5(const ZipFiles& files, unsigned flags = 0, unsigned method = 0) {
  const auto number = [](std::uint64_t value) {
    std::string bytes;
    for (; value >= 0x80; value >>= 7) bytes += static_cast<char>((value & 0x7f) | 0x80);
    return bytes + static_cast<char>(value);
  };
  const auto seal = [&](const std::string& header) {
    const std::string sized = number(header.size()) + header;
    return to_little_endian({{find_crc32(sized), 4}}) + sized;
  };
  std::string rar("Rar!\x1A\x07\x01\0", 8);
  rar += seal(number(1) + number(0) + number(flags));
  for (const auto& [name, bytes] : files)
    rar += seal(number(2) + number(2) + number(bytes.size()) + number(4) + number(bytes.size()) +
                number(0100644) + to_little_endian({{find_crc32(bytes), 4}}) + number(method << 7) +
                number(1) + number(name.size()) + name) +
           bytes;
  return rar + seal(number(5) + number(0) + number(0));
}

/// Returns a 7z archive whose one file is, by what its header says, encrypted by AES.
inline std::string make_encrypted_7z(const std::string& name, std::string_view bytes) {
  const TempFolder folder;
  ArchiveWriter(folder / "a.7z", ARCHIVE_FORMAT_7ZIP, "compression=store").add(name, bytes);
  const std::string archive = read_text(folder / "a.7z");
  constexpr std::size_t begin = 32;  // of what is packed, behind the first header
  const std::size_t packed = begin + bytes.size();
  std::string header = archive.substr(packed);
  const std::string_view stored("\x0B\x01\0\x01\x01\0", 6), aes("\x24\x06\xF1\x07\x01\x02\0\0", 8);
  const std::size_t coder = header.find(stored);
  EXPECT_NE(coder, header.npos);
  header.replace(coder + 4, 2, aes);
  const std::string first =
      to_little_endian({{bytes.size(), 8}, {header.size(), 8}, {find_crc32(header), 4}});
  return archive.substr(0, 8) + to_little_endian({{find_crc32(first), 4}}) + first +
         archive.substr(begin, bytes.size()) + header;
}

/// Writes one stream, packed as the ending of `path` says.
inline void pack_stream(const std::filesystem::path& path, std::string_view bytes) {
  ArchiveWriter out(path, ARCHIVE_FORMAT_RAW);
  out.add("data", bytes);
}

/// Writes an archive in the form that the ending of `path` says (archive_forms).
inline void pack_archive(const std::filesystem::path& path, const ZipFiles& files) {
  const std::string name = path.string();
  if (name.ends_with(".zip")) return pack_zip(path, files);
  if (name.ends_with(".rar")) return write_text(path, make_rar4(files));
  if (name.ends_with(".rar5")) return write_text(path, make_rar5(files));
  if (name.ends_with(".7z.xz")) {
    const TempFolder folder;
    pack_archive(folder / "a.7z", files);
    return pack_stream(path, read_text(folder / "a.7z"));
  }
  ArchiveWriter out(
      path, name.ends_with(".7z") ? ARCHIVE_FORMAT_7ZIP : ARCHIVE_FORMAT_TAR_PAX_RESTRICTED);
  for (const auto& [inside, bytes] : files) out.add(inside, bytes);
}

/// Returns the bytes of such an archive.
inline std::string make_archive(const std::string& ending, const ZipFiles& files) {
  const TempFolder folder;
  pack_archive(folder / ("a" + ending), files);
  return read_text(folder / ("a" + ending));
}

}  // namespace nightcity::test
