// libFuzzer's mutations of archives: they change what one entry holds and pack it again, because
// bytes that are changed in a deflated entry end in its checksum, before our readers.
#pragma once

#include <archive.h>
#include <archive_entry.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace nightcity::test {

constexpr std::size_t max_unpacked_entry = std::size_t{1} << 18;

/// Returns what an entry unpacks to, cut off at `max_unpacked_entry`; "" where it cannot.
inline std::string unpack_entry(zip_t* archive, zip_uint64_t number) {
  zip_file_t* entry = zip_fopen_index(archive, number, 0);
  if (!entry) return {};
  std::string text(max_unpacked_entry, '\0');
  const zip_int64_t size = zip_fread(entry, text.data(), text.size());
  zip_fclose(entry);
  text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
  return text;
}

/// Returns the archive with one entry changed, one in four of them stored without packing; "" where
/// the file is no archive that libzip can follow.
inline std::string mutate_zip(std::string_view file, unsigned seed) {
  zip_error_t error;
  zip_error_init(&error);
  // libzip frees what it writes over.
  void* const copy = std::malloc(std::max<std::size_t>(file.size(), 1));
  std::copy(file.begin(), file.end(), static_cast<char*>(copy));
  zip_source_t* source = zip_source_buffer_create(copy, file.size(), 1, &error);
  if (!source) {
    std::free(copy);
    return {};
  }
  zip_source_keep(source);  // beyond the archive, to read what was written
  const auto release = [](zip_source_t* kept) { zip_source_free(kept); };
  const std::unique_ptr<zip_source_t, decltype(release)> kept(source, release);
  zip_t* archive = zip_open_from_source(source, 0, &error);
  if (!archive) {
    zip_source_free(source);
    return {};
  }
  const zip_int64_t entries = zip_get_num_entries(archive, 0);
  std::string text;
  if (entries > 0) {
    const zip_uint64_t chosen = seed / 32 % static_cast<zip_uint64_t>(entries);
    text = unpack_entry(archive, chosen);
    const std::size_t size = text.size(), room = size + 64;
    text.resize(room);
    text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, room));
    zip_source_t* changed = zip_source_buffer(archive, text.data(), text.size(), 0);
    if (changed && zip_file_replace(archive, chosen, changed, 0) != 0) zip_source_free(changed);
    zip_set_file_compression(archive, chosen, seed / 8 % 4 == 0 ? ZIP_CM_STORE : ZIP_CM_DEFLATE, 1);
  }
  if (entries <= 0 || zip_close(archive) != 0) {
    zip_discard(archive);
    return {};
  }
  if (zip_source_open(source) != 0) return {};
  std::string packed(file.size() + 2 * max_unpacked_entry, '\0');
  const zip_int64_t size = zip_source_read(source, packed.data(), packed.size());
  zip_source_close(source);
  packed.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
  return packed;
}

/// Returns a tar or 7z archive, maybe in a stream, with what a tar, 7z, RAR or stream holds, one
/// entry of it changed; "" where the file is none that libarchive can follow.
inline std::string mutate_other(std::string_view file, unsigned seed) {
  struct Freed {
    void operator()(archive* object) const { archive_free(object); }
    void operator()(archive_entry* object) const { archive_entry_free(object); }
  };
  // Before the writer, which may write to them as it is freed.
  std::string packed(file.size() + 2 * max_unpacked_entry, '\0');
  std::size_t used = 0;
  const std::unique_ptr<archive, Freed> in(archive_read_new()), out(archive_write_new());
  archive_read_support_filter_all(in.get());
  for (const auto support : {archive_read_support_format_tar, archive_read_support_format_7zip,
                             archive_read_support_format_rar, archive_read_support_format_rar5})
    support(in.get());
  if (archive_read_open_memory(in.get(), file.data(), file.size()) != ARCHIVE_OK) return {};
  const bool is_7z = seed / 8 % 4 == 0;
  archive_write_set_format(out.get(),
                           is_7z ? ARCHIVE_FORMAT_7ZIP : ARCHIVE_FORMAT_TAR_PAX_RESTRICTED);
  constexpr std::array<int, 4> filters{ARCHIVE_FILTER_NONE, ARCHIVE_FILTER_GZIP, ARCHIVE_FILTER_XZ,
                                       ARCHIVE_FILTER_ZSTD};
  if (!is_7z) archive_write_add_filter(out.get(), filters[seed / 32 % filters.size()]);
  archive_write_open_memory(out.get(), packed.data(), packed.size(), &used);
  archive_entry* entry = nullptr;
  std::size_t number = 0;
  std::string text;
  for (; archive_read_next_header(in.get(), &entry) == ARCHIVE_OK && number < 16; ++number) {
    text.assign(max_unpacked_entry / 4, '\0');
    const la_ssize_t size = archive_read_data(in.get(), text.data(), text.size());
    text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    if (number == seed / 128 % 4) {
      const std::size_t before = text.size(), room = before + 64;
      text.resize(room);
      text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), before, room));
    }
    const std::unique_ptr<archive_entry, Freed> copy(archive_entry_clone(entry));
    archive_entry_set_size(copy.get(), static_cast<la_int64_t>(text.size()));
    archive_entry_sparse_clear(copy.get());
    if (archive_write_header(out.get(), copy.get()) < ARCHIVE_WARN) return {};
    archive_write_data(out.get(), text.data(), text.size());
  }
  if (number == 0 || archive_write_close(out.get()) != ARCHIVE_OK) return {};
  packed.resize(used);
  return packed;
}

}  // namespace nightcity::test

/// One in eight mutations is libFuzzer's own, so that headers and packings are changed too.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  std::string mutated;
  if (seed % 8 != 0)
    mutated = nightcity::test::mutate_zip({reinterpret_cast<const char*>(data), size}, seed);
  if (seed % 8 != 0 && mutated.empty())
    mutated = nightcity::test::mutate_other({reinterpret_cast<const char*>(data), size}, seed);
  if (mutated.empty() || mutated.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(mutated.begin(), mutated.end(), data);
  return mutated.size();
}
