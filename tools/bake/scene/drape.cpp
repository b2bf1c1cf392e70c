#include "tools/bake/scene/drape.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

namespace nightcity::bake {
namespace {

// Ground between the points of a 10 m grid is flat enough for a street.
constexpr double max_edge_m = 10;
// Above the ground, so that the two surfaces do not lie in one place.
constexpr double clearance_m = 0.1;

using Corners = std::array<glm::dvec3, 3>;

double plan_distance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(glm::dvec2(a), glm::dvec2(b));
}

}  // namespace

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
        (a + b) / 2.0;  // the same bits in whichever direction the neighbour has the edge
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

std::size_t DrapeStore::drape(
    const std::function<std::optional<double>(const glm::dvec2&)>& height_at, TileStore& tiles) {
  std::vector<TileStore::Triangle> pieces;
  // Heights of the feature's points: each belongs to several pieces.
  std::map<std::pair<double, double>, double> known;
  std::uint32_t feature = no_id;
  std::size_t added = 0;
  const auto flush = [&] {
    tiles.add(pieces, feature);
    added += pieces.size();
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
    subdivide(record.triangle.corners, max_edge_m, [&](const glm::dvec3(&corners)[3]) {
      TileStore::Triangle piece{
          {corners[0], corners[1], corners[2]}, record.triangle.material, record.triangle.kind};
      for (glm::dvec3& p : piece.corners) p.z = height_of(p);
      pieces.push_back(piece);
    });
  }
  flush();
  return added;
}

}  // namespace nightcity::bake
