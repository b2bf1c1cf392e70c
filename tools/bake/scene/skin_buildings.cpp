#include "tools/bake/scene/skin_buildings.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "tools/random.h"

namespace nightcity::bake {
namespace {

// No roof of tiles is flatter by the rules of the German roofers (ZVDH, Fachregel für Dachdeckungen
// mit Dachziegeln und Dachsteinen).
constexpr double min_tiled_pitch_deg = 10;

std::uint64_t make_key(const PreparedObject& building) {
  const std::string& id = building.object.id;
  if (!id.empty() || building.mesh.positions.empty()) return hash_text(id);
  std::uint64_t key = 0;
  const glm::dvec3& place = building.mesh.positions.front();
  for (int axis = 0; axis < 3; ++axis)
    key = mix(key ^ static_cast<std::uint64_t>(std::llround(place[axis] * 100)));
  return key;
}

// The sources of the colours that the walls or the roofs of one building have got.
struct Dress {
  bool from_table = false, own = false;

  void count(bool of_map, std::map<std::string, std::size_t>& sources) const {
    if (from_table)
      ++sources["table"];
    else if (own)
      ++sources[of_map ? "map" : "model"];
  }
};

}  // namespace

std::optional<SkinPart> find_skin_part(const TileStore::Triangle& triangle) {
  if (triangle.material == to_code(BakeMaterial::wall)) return SkinPart::walls;
  if (triangle.material != to_code(BakeMaterial::roof)) return std::nullopt;
  const auto& [a, b, c] = triangle.corners;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  static const double flattest = std::cos(glm::radians(min_tiled_pitch_deg));
  const bool is_flat = std::abs(normal.z) >= flattest * glm::length(normal);
  return is_flat ? SkinPart::flat_roof : SkinPart::pitched_roof;
}

BuildingSkin BuildingSkinner::find_skin(const PreparedObject& building) const {
  const lights::BuildingUse use =
      building.use ? *building.use : lights::use_of(building.object, use_at_).use;
  return draw_skin(make_key(building), use, find_age(building.object.year));
}

void BuildingSkinner::apply(const BuildingSkin& skin, const city::CityObject& building,
                            bool continues, std::span<TileStore::Triangle> triangles) {
  if (!continues) last_ = skin;
  Dress walls, roofs;
  for (TileStore::Triangle& triangle : triangles) {
    const bool is_wall = is_of_kind(triangle.material, BakeMaterial::wall);
    if (!is_wall && !is_of_kind(triangle.material, BakeMaterial::roof)) continue;
    Dress& dress = is_wall ? walls : roofs;
    const auto part = find_skin_part(triangle);
    (part ? dress.from_table : dress.own) = true;
    if (part)
      triangle.material =
          to_code(is_wall ? BakeMaterial::wall : BakeMaterial::roof, last_.of(*part));
  }
  if (continues) return;
  walls.count(building.of_map, report_.walls);
  roofs.count(building.of_map, report_.roofs);
  if (walls.from_table || roofs.from_table) ++report_.ages[name_of(find_age(building.year))];
}

}  // namespace nightcity::bake
