#include "tools/osm/split_maps.h"

#include <osmium/io/any_input.hpp>
#include <osmium/io/pbf_output.hpp>
#include <osmium/osm/object_comparisons.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include "formats/file_names.h"
#include "tools/osm/map_file.h"
#include "tools/osm/packed_map.h"

namespace nightcity::osm {
namespace {

using std::filesystem::path;

// Returns whether a map has ways or relations, and no place of a node.
bool lacks_places(const path& file) {
  return read_map_file(file, [&](const path& plain) {
    osmium::io::Reader reader(open_packed_map(plain), osmium::osm_entity_bits::nwr);
    bool has_others = false;
    while (const osmium::memory::Buffer buffer = reader.read()) {
      for (const osmium::OSMObject& object : buffer.select<osmium::OSMObject>()) {
        if (object.type() == osmium::item_type::node) return false;
        if (object.type() == osmium::item_type::way)
          for (const osmium::NodeRef& node : static_cast<const osmium::Way&>(object).nodes())
            if (node.location().valid()) return false;
        has_others = true;
      }
    }
    return has_others;
  });
}

bool is_split(std::span<const path> files) {
  std::error_code ignored;
  const auto is_there = [&](const path& file) {
    return std::filesystem::is_regular_file(file, ignored);
  };
  if (files.size() < 2 || !std::all_of(files.begin(), files.end(), is_there)) return false;
  try {
    return std::any_of(files.begin(), files.end(), lacks_places);
  } catch (const std::exception&) {  // its reader says what is wrong
    return false;
  }
}

// The rectangle round what the files say that they hold, where all of them do.
osmium::Box find_bounds(std::span<const path> files) {
  osmium::Box all;
  for (const path& file : files) {
    const osmium::Box box = read_map_file(file, [&](const path& plain) {
      return osmium::io::Reader(open_packed_map(plain), osmium::osm_entity_bits::nothing)
          .header()
          .joined_boxes();
    });
    if (!box.valid()) return {};
    all.extend(box);
  }
  return all;
}

// Returns false where the files hold ids that mean another thing in each.
bool write_joined(std::span<const path> files, const osmium::Box& bounds, const path& out) {
  SortedMap map;
  for (const path& file : files) read_map_file(file, [&](const path& plain) { map.add(plain); });
  map.sort_newest_first();
  osmium::io::Header header;
  if (bounds.valid()) header.add_box(bounds);
  osmium::io::Writer writer(osmium::io::File(out.string(), "pbf"), header,
                            osmium::io::overwrite::allow);
  osmium::object_id_type last_id = 0;
  osmium::item_type last_type = osmium::item_type::undefined;
  for (const osmium::OSMObject& object : map) {
    if (object.id() < 0) return false;
    if (object.type() == last_type && object.id() == last_id) continue;
    last_type = object.type();
    last_id = object.id();
    if (object.visible()) writer(object);
  }
  writer.close();
  return true;
}

std::string write_empty(const osmium::Box& bounds) {
  std::string text = "<osm version='0.6'>";
  if (bounds.valid()) {
    char box[256];
    std::snprintf(box, sizeof box,
                  "<bounds minlon='%.7f' minlat='%.7f' maxlon='%.7f' maxlat='%.7f'/>",
                  bounds.bottom_left().lon(), bounds.bottom_left().lat(), bounds.top_right().lon(),
                  bounds.top_right().lat());
    text += box;
  }
  return text + "</osm>";
}

}  // namespace

JoinedMaps join_split_maps(std::span<const path> files) {
  if (!is_split(files)) return {};
  JoinedMaps joined;
  const auto add_file = [&] {
    return joined.emplace_back(std::make_shared<ScratchFile>(scratch_folder() / "map"));
  };
  try {
    const osmium::Box bounds = find_bounds(files);
    if (!write_joined(files, bounds, add_file()->path_while_open())) return {};
    const std::string empty = write_empty(bounds);
    while (joined.size() < files.size()) {
      const auto file = add_file();
      file->write(empty.data(), empty.size());
      file->flush();
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr,
                 "note: %s and the maps beside it: one has no nodes of its own, and they cannot be "
                 "joined here (%s): join them by `osmium merge`\n",
                 files.front().c_str(), error.what());
    return {};
  }
  for (std::size_t i = 0; i < files.size(); ++i) set_stand_in(files[i], joined[i]);
  return joined;
}

}  // namespace nightcity::osm
