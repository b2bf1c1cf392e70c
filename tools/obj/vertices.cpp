#include "tools/obj/vertices.h"

#include <functional>
#include <glm/common.hpp>
#include <limits>
#include <string_view>
#include <unordered_set>

#include "formats/error.h"
#include "tools/obj/text_lines.h"

namespace nightcity::obj {
namespace {

// Counts different names, as far as two.
class Names {
 public:
  void add(std::string_view name) {
    if (hashes_.size() < 2) hashes_.insert(std::hash<std::string_view>()(name));
  }
  bool are_several() const { return hashes_.size() > 1; }

 private:
  std::unordered_set<std::size_t> hashes_;
};

// A city is wider than it is high.
bool is_y_up(const std::vector<glm::dvec3>& places) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const glm::dvec3& p : places) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return high.y - low.y < high.z - low.z;
}

}  // namespace

Vertices read_vertices(const city::Document& document, const city::ReadOptions& options,
                       std::size_t most) {
  Vertices result;
  const city::MeshPlacement& placement = options.mesh;
  TextLines lines(document.open(), document.name);
  Names objects, groups;
  result.keeps_texture_places = options.textures != city::Textures::none && most == 0;
  const auto check_count = [&](std::size_t count) {
    if (count >= static_cast<std::size_t>(placement.max_vertices))
      throw Error(document.name, lines.number(),
                  "the file has more vertices than [city] obj_max_vertices = " +
                      std::to_string(placement.max_vertices));
  };
  for (std::string_view line; lines.next(line);) {
    const std::string_view key = take_word(line);
    if (key == "o") objects.add(line);
    if (key == "g") groups.add(line);
    if (result.keeps_texture_places && key == "mtllib") result.libraries.emplace_back(line);
    if (result.keeps_texture_places && key == "vt") {
      check_count(result.texture_places.size());
      glm::dvec2 place(0);
      if (take_number(line, place.x)) take_number(line, place.y);  // one that is absent is 0
      result.texture_places.emplace_back(place);
    }
    if (key != "v") continue;
    glm::dvec3 p;
    if (!take_number(line, p.x) || !take_number(line, p.y) || !take_number(line, p.z))
      throw Error(document.name, lines.number(), "a vertex (v) is not three finite numbers");
    check_count(result.places.size());
    result.places.push_back(p);
    if (result.places.size() == most) break;
  }
  result.grouping = objects.are_several()  ? Grouping::by_object
                    : groups.are_several() ? Grouping::by_group
                                           : Grouping::by_connection;
  result.up_is_said = placement.up != city::MeshPlacement::Up::automatic;
  result.y_up =
      result.up_is_said ? placement.up == city::MeshPlacement::Up::y : is_y_up(result.places);
  for (glm::dvec3& p : result.places) {
    if (result.y_up) p = {p.x, -p.z, p.y};  // as glTF: x east, y up, z south
    p = p * placement.unit_m + placement.origin;
  }
  return result;
}

}  // namespace nightcity::obj
