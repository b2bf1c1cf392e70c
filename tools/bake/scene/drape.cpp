#include "tools/bake/scene/drape.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace nightcity {
namespace {

constexpr double longest_edge_m =
    10;  // ground between points of a 10 m grid is flat enough for a street
constexpr double clearance_m =
    0.1;  // above the ground, so that the two do not fight over what is seen

using Corners = std::array<glm::dvec3, 3>;

double plan_distance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(glm::dvec2(a), glm::dvec2(b));
}

}  // namespace

bool lacks_heights(const CityObject& object) {
  switch (object.type) {
    case ObjectType::road:
    case ObjectType::railway:
    case ObjectType::land_use:
    case ObjectType::water:
    case ObjectType::vegetation:
      break;
    default:
      return false;
  }
  for (const Polygon& polygon : object.polygons)
    for (const glm::dvec3& p : polygon.exterior)
      if (p.z != 0) return false;
  return true;
}

void subdivide(const glm::dvec3 (&corners)[3], double longest_m,
               const std::function<void(const glm::dvec3 (&)[3])>& sink) {
  std::vector<Corners> stack{{corners[0], corners[1], corners[2]}};
  while (!stack.empty()) {
    const Corners t = stack.back();
    stack.pop_back();
    std::size_t longest = 0;  // edge k runs from corner k to the next
    for (std::size_t k = 1; k < 3; ++k)
      if (plan_distance(t[k], t[(k + 1) % 3]) > plan_distance(t[longest], t[(longest + 1) % 3]))
        longest = k;
    const glm::dvec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
    if (!(plan_distance(a, b) > longest_m)) {
      sink({t[0], t[1], t[2]});
      continue;
    }
    const glm::dvec3 middle =
        (a + b) / 2.0;  // the same bits whichever way the neighbour walks the edge
    stack.push_back({a, middle, c});
    stack.push_back({middle, b, c});
  }
}

struct DrapeStore::Record {
  TileStore::Triangle triangle;
  std::uint32_t feature;
};

void DrapeStore::add(std::span<const TileStore::Triangle> triangles, std::uint32_t feature) {
  for (const TileStore::Triangle& triangle : triangles) {
    const Record record{triangle, feature};
    file_.write(&record, sizeof record);
  }
}

std::size_t DrapeStore::lay(
    const std::function<std::optional<double>(const glm::dvec2&)>& height_at, TileStore& tiles) {
  std::vector<TileStore::Triangle> pieces;
  std::map<std::pair<double, double>, double>
      known;  // heights of the feature's points: each serves several pieces
  std::uint32_t feature = no_id;
  std::size_t laid = 0;
  const auto flush = [&] {
    tiles.add(pieces, feature);
    laid += pieces.size();
    pieces.clear();
    known.clear();
  };
  const auto height_of = [&](const glm::dvec3& p) {
    const auto [found, is_new] = known.try_emplace({p.x, p.y}, p.z);
    if (is_new)
      if (const auto height = height_at(glm::dvec2(p))) found->second = *height + clearance_m;
    return found->second;
  };
  for (std::uint64_t offset = 0; offset < file_.size(); offset += sizeof(Record)) {
    Record record;
    file_.read(offset, &record, sizeof record);
    if (record.feature != feature) flush();
    feature = record.feature;
    subdivide(record.triangle.corners, longest_edge_m, [&](const glm::dvec3(&corners)[3]) {
      TileStore::Triangle piece{
          {corners[0], corners[1], corners[2]}, record.triangle.material, record.triangle.kind};
      for (glm::dvec3& p : piece.corners) p.z = height_of(p);
      pieces.push_back(piece);
    });
  }
  flush();
  return laid;
}

}  // namespace nightcity
