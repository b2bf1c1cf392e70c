// libFuzzer's mutations of archives: they change what one entry holds and pack it again, because
// bytes that are changed in a deflated entry end in its checksum, before our readers.
#pragma once

#include <zip.h>

#include <algorithm>
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

}  // namespace nightcity::test

/// One in eight mutations is libFuzzer's own, so that headers and packings are changed too.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  std::string mutated;
  if (seed % 8 != 0)
    mutated = nightcity::test::mutate_zip({reinterpret_cast<const char*>(data), size}, seed);
  if (mutated.empty() || mutated.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(mutated.begin(), mutated.end(), data);
  return mutated.size();
}
