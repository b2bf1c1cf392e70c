#include "tools/map_buildings/shell.h"

#include <algorithm>
#include <utility>

namespace nightcity::map_buildings {
namespace {

city::Ring lift(const Ring2& ring, const HeightOver& height) {
  city::Ring out;
  for (const glm::dvec2& p : ring) out.emplace_back(p, height(p));
  return out;
}

city::Ring level(const Ring2& ring, double height) {
  return lift(ring, [height](const glm::dvec2&) { return height; });
}

city::Polygon make_polygon(city::SurfaceType surface, city::Ring exterior) {
  city::Polygon polygon;
  polygon.surface = surface;
  polygon.exterior = std::move(exterior);
  return polygon;
}

}  // namespace

void Shell::add_plane(const HeightOver& height) {
  city::Polygon roof = make_polygon(city::SurfaceType::roof, lift(outline_.outer, height));
  add_walls(outline_.outer, height);
  for (const Ring2& hole : outline_.holes) {
    roof.interiors.push_back(lift(hole, height));
    add_walls(hole, height);
  }
  polygons_.push_back(std::move(roof));
}

void Shell::add_walls(const Ring2& ring, const HeightOver& height) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    add_wall({glm::dvec3(a, sizes_.foot_m), glm::dvec3(b, sizes_.foot_m), glm::dvec3(b, height(b)),
              glm::dvec3(a, height(a))});
  }
}

void Shell::add_wall(city::Ring corners) {
  polygons_.push_back(make_polygon(city::SurfaceType::wall, std::move(corners)));
}

void Shell::add_roof(city::Ring corners) {
  polygons_.push_back(make_polygon(city::SurfaceType::roof, std::move(corners)));
}

std::vector<city::Polygon> Shell::take() {
  // A part that hangs in the air has no ground surface, because the ground would be made through
  // it.
  const auto surface =
      sizes_.foot_m > 0 ? city::SurfaceType::outer_ceiling : city::SurfaceType::ground;
  city::Polygon floor = make_polygon(surface, level(floor_, sizes_.foot_m));
  for (const Ring2& hole : outline_.holes) floor.interiors.push_back(level(hole, sizes_.foot_m));
  std::reverse(floor.exterior.begin(), floor.exterior.end());
  for (city::Ring& hole : floor.interiors) std::reverse(hole.begin(), hole.end());
  polygons_.push_back(std::move(floor));
  return std::move(polygons_);
}

}  // namespace nightcity::map_buildings
