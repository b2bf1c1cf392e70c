// How a file is packed: its first bytes tell it, its name says only whether it is worth a look.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nightcity::city {

enum class Packing : std::uint8_t {
  none,
  // Streams: what they hold is one file.
  gzip,
  bzip2,
  xz,
  lzma,
  zstd,
  lz4,
  lzip,
  compress,
  // Archives: what they hold has names.
  zip,
  tar,
  seven_zip,
  rar,
};

/// Enough of a file to tell how it is packed.
constexpr std::size_t packing_bytes = 512;

/// Returns how a file is packed that begins so. A tar archive that a stream packs once more is that
/// stream. A zip archive without files is none.
Packing find_packing(std::string_view start);
bool is_stream(Packing packing);
/// Returns whether it is a stream that shows where it was cut off: one of compress does not.
bool is_checked_stream(Packing packing);
bool is_archive(Packing packing);
/// Returns the word for messages: "gzip", "7z".
const char* name_of(Packing packing);

/// Returns a name without the ending of a stream: "a.gml" of "a.gml.xz", and any other as it is.
/// Case does not count.
std::string_view without_stream_ending(std::string_view name);
/// Returns whether a name (in lower case) ends as those of archives do, also of those that are
/// packed by a stream.
bool is_named_as_archive(std::string_view name);
/// Returns whether a name (in lower case) ends as that of anything packed.
bool is_named_as_packed(std::string_view name);
/// Returns whether a name (in lower case) is that of one of several files which make an archive
/// together.
bool is_named_as_volume(std::string_view name);
constexpr const char* volume_words =
    "is one of several volumes of an archive: unpack them together first, and name what is inside";

}  // namespace nightcity::city
