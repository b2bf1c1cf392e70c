#include "runtime/measure/exr_claims.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTileDescription.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "runtime/measure/limits.h"

namespace nightcity::measure {
namespace {

constexpr std::size_t header_begin = 8;  // behind the mark and the version
constexpr std::size_t max_channels = 256;

// Types of attributes whose values have one size. OpenEXR reads so many bytes of them, whatever the
// file says that they have, and goes on behind.
using SizedType = std::pair<std::string_view, std::size_t>;
constexpr SizedType fixed_sizes[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"deepImageState", 1},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};

// Goes through the attributes of a file's headers.
class Attributes {
 public:
  explicit Attributes(std::span<const std::byte> bytes) : bytes_(bytes) {}

  // Ends where the headers do, or the file: OpenEXR says so then.
  void check() {
    constexpr std::uint32_t multi_part = 0x1000;
    const bool has_parts = (read_number(4) & multi_part) != 0;
    do {
      while (true) {
        const auto name = take_text();
        if (!name) return;
        if (name->empty()) break;
        const auto type = take_text();
        if (!type || bytes_.size() - position_ < 4) return;
        const std::uint32_t size = read_number(position_);
        position_ += 4;
        if (size > bytes_.size() - position_) fail(*name, size, "and the file ends before");
        const std::size_t end = position_ + size;
        if (!is_whole(*type, end)) fail(*name, size, "which are none of its type");
        position_ = end;
      }
    } while (has_parts && position_ < bytes_.size() && bytes_[position_] != std::byte{0});
  }

 private:
  [[noreturn]] void fail(std::string_view name, std::uint32_t size, const char* why) const {
    throw Error({}, fmt::format("byte {}", position_ - 4),
                fmt::format("attribute {} claims {} bytes, {}", name, size, why));
  }

  // Returns whether a value that begins here ends at `end`.
  bool is_whole(std::string_view type, std::size_t end) {
    for (const auto& [fixed, size] : fixed_sizes)
      if (type == fixed) return end - position_ == size;
    if (type == "chlist") {
      constexpr std::size_t channel_bytes = 16;
      while (const auto name = take_text()) {
        if (name->empty() || position_ > end) break;
        position_ += std::min(channel_bytes, bytes_.size() - position_);
      }
      return position_ == end;
    }
    if (type == "stringvector") {
      while (position_ + 4 <= end && read_number(position_) <= end - position_ - 4)
        position_ += 4 + read_number(position_);
      return position_ == end;
    }
    if (type == "preview")
      return end - position_ >= 8 &&
             std::uint64_t{read_number(position_)} * read_number(position_ + 4) ==
                 (end - position_ - 8) / 4;
    if (type == "floatvector") return (end - position_) % 4 == 0;
    return type != "idmanifest" || end - position_ >= 4;
  }

  std::uint32_t read_number(std::size_t at) const {
    std::uint32_t number = 0;
    if (at + sizeof number <= bytes_.size()) std::memcpy(&number, &bytes_[at], sizeof number);
    return number;
  }

  // Returns the text that begins here, nothing where it does not end; passes its end.
  std::optional<std::string_view> take_text() {
    const auto rest = bytes_.subspan(position_);
    const auto end = std::find(rest.begin(), rest.end(), std::byte{0});
    if (end == rest.end()) return std::nullopt;
    const auto length = static_cast<std::size_t>(end - rest.begin());
    position_ += length + 1;
    return std::string_view(reinterpret_cast<const char*>(rest.data()), length);
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = std::min(header_begin, bytes_.size());
};

// Returns the lines that are compressed together.
std::uint64_t count_lines(Imf::Compression compression) {
  switch (compression) {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    case Imf::DWAB_COMPRESSION:
      return 256;
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
    case Imf::NUM_COMPRESSION_METHODS:
      break;
  }
  return 1;
}

std::uint64_t divide_up(std::uint64_t count, std::uint64_t by) {
  return (count + by - 1) / by;
}

void check_header(const Imf::Header& header, std::uint64_t file_bytes) {
  const Imath::Box2i window = header.dataWindow();
  // In 64 bits, because a hostile window may span all of int.
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > max_image_side || height > max_image_side)
    throw Error(
        {}, fmt::format("{} x {} pixels: a side must be 1 to {}", width, height, max_image_side));
  std::uint64_t pixel_bytes = 0;
  std::size_t channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (++channels > max_channels)
      throw Error({}, fmt::format("more than {} channels", max_channels));
    pixel_bytes += it.channel().type == Imf::HALF ? 2 : 4;
  }

  const auto columns = static_cast<std::uint64_t>(width), rows = static_cast<std::uint64_t>(height);
  std::uint64_t chunk_columns = columns, chunk_rows = count_lines(header.compression());
  if (header.hasTileDescription()) {
    const Imf::TileDescription& tiles = header.tileDescription();
    chunk_columns = std::max(tiles.xSize, 1u);
    chunk_rows = std::max(tiles.ySize, 1u);
  }
  // The file has the place of each chunk, in 8 bytes.
  const std::uint64_t chunks = divide_up(columns, chunk_columns) * divide_up(rows, chunk_rows);
  if (chunks > file_bytes / 8)
    throw Error({}, fmt::format("claims {} chunks, which the file is too short for", chunks));
  // A row of tiles is unpacked at once. No compression makes bytes a thousandth of what they were
  // but for pictures of one colour.
  constexpr std::uint64_t max_ratio = 5'000, free_bytes = 16'000'000;
  const std::uint64_t in_row = std::max(chunk_columns, columns);
  if (chunk_rows >
      (max_ratio * file_bytes + free_bytes) / (in_row * std::max<std::uint64_t>(pixel_bytes, 1)))
    throw Error({}, fmt::format("claims chunks of {} x {} pixels, which the file is too short for",
                                in_row, chunk_rows));
}

}  // namespace

void refuse_false_claims(std::span<const std::byte> bytes, Imf::IStream& stream) {
  Attributes(bytes).check();
  if (bytes.size() <= header_begin) return;
  int version = 0;
  std::memcpy(&version, &bytes[4], sizeof version);
  Imf::Header header;
  stream.seekg(header_begin);
  header.readFrom(stream, version);
  check_header(header, bytes.size());
  stream.seekg(0);
}

}  // namespace nightcity::measure
