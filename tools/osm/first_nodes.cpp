#include "tools/osm/first_nodes.h"

#include <osmium/io/any_input.hpp>

#include <cmath>

#include "tools/osm/map_file.h"
#include "tools/osm/osm_document.h"
#include "tools/osm/packed_map.h"
#include "tools/osm/read_guarded.h"

namespace nightcity::osm {
namespace {

void take_places(const pugi::xml_node& parent, const char* name, std::vector<glm::dvec2>& places,
                 std::size_t count) {
  for (const pugi::xml_node& element : parent.children(name)) {
    if (places.size() >= count) return;
    const glm::dvec2 place = read_place(element);
    if (std::abs(place.x) <= 180 && std::abs(place.y) <= 90) places.push_back(place);
  }
}

std::vector<glm::dvec2> read_nodes(const std::filesystem::path& file, std::size_t count) {
  return read_guarded(file, [&] {
    std::vector<glm::dvec2> places;
    if (const auto document = find_osm_document(file)) {
      const pugi::xml_node root = document->child("osm");
      take_places(root, "node", places, count);
      for (const pugi::xml_node& way : root.children("way")) take_places(way, "nd", places, count);
      for (const pugi::xml_node& relation : root.children("relation"))
        for (const pugi::xml_node& member : relation.children("member"))
          take_places(member, "nd", places, count);
      return places;
    }
    osmium::io::Reader reader(open_packed_map(file), osmium::osm_entity_bits::nwr);
    const auto take = [&](const osmium::Location& place) {
      if (place.valid() && places.size() < count) places.emplace_back(place.lon(), place.lat());
    };
    while (places.size() < count) {
      const osmium::memory::Buffer buffer = reader.read();
      if (!buffer) break;
      for (const osmium::Node& node : buffer.select<osmium::Node>()) take(node.location());
      for (const osmium::Way& way : buffer.select<osmium::Way>())
        for (const osmium::NodeRef& node : way.nodes()) take(node.location());
    }
    reader.close();
    return places;
  });
}

}  // namespace

std::vector<glm::dvec2> read_first_nodes(const std::filesystem::path& file, std::size_t count) {
  return read_map_file(
      file, [&](const std::filesystem::path& plain) { return read_nodes(plain, count); });
}

}  // namespace nightcity::osm
