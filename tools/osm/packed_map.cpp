#include "tools/osm/packed_map.h"

#include <osmium/io/any_input.hpp>
#include <osmium/osm/object_comparisons.hpp>

#include <array>
#include <fstream>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "tools/osm/closing_parser.h"
#include "tools/osm/osm_marks.h"
#include "tools/osm/whole_tags.h"

namespace nightcity::osm {

osmium::io::File open_packed_map(const std::filesystem::path& file, const std::string& format) {
  close_broken_maps();
  return osmium::io::File(file.string(), format);
}

osmium::io::File open_packed_map(const std::filesystem::path& file) {
  std::array<char, 64> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  const std::string_view start(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (start.empty()) throw Error(file.string(), "cannot be read, or is empty");
  const char* format = start.starts_with("\x1f\x8b") ? "osm.gz"
                       : is_bzip2(start)             ? "osm.bz2"
                       : is_o5m(start)               ? "o5m"
                       : is_osm_pbf(start)           ? "pbf"
                                                     : "osm";
  return open_packed_map(file, format);
}

SortedMap::SortedMap(const std::filesystem::path& file) {
  add(file);
  objects_.sort(osmium::object_order_type_id_version{});
}

void SortedMap::sort_newest_first() {
  objects_.sort(osmium::object_order_type_id_reverse_version{});
}

void SortedMap::add(const std::filesystem::path& file) {
  constexpr std::uintmax_t max_bytes = 256 << 20;
  constexpr std::size_t max_unpacked_bytes = std::size_t{4} << 30;
  constexpr const char* too_large =
      "its elements are in no order, and it is too large to be sorted here: sort it by "
      "`osmium sort IN -o OUT`";
  std::error_code ignored;
  if (std::filesystem::file_size(file, ignored) > max_bytes) throw Error(file.string(), too_large);
  osmium::io::Reader reader(open_packed_map(file), osmium::osm_entity_bits::nwr,
                            osmium::io::read_meta::yes);
  const std::size_t known = buffers_.size();
  while (osmium::memory::Buffer buffer = reader.read()) {
    unpacked_ += buffer.committed();  // a small file may unpack to a thousand times its size
    if (unpacked_ > max_unpacked_bytes) throw Error(file.string(), too_large);
    buffers_.push_back(std::move(buffer));
  }
  reader.close();
  ObjectCheck check;
  for (std::size_t i = known; i < buffers_.size(); ++i) osmium::apply(buffers_[i], check, objects_);
}

}  // namespace nightcity::osm
