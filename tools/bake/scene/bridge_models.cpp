#include "tools/bake/scene/bridge_models.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/bake/scene/cover_ground.h"
#include "tools/bake/scene/deck_surface.h"
#include "tools/barriers/barrier_shape.h"

namespace nightcity::bake {
namespace {

using Triangle = TileStore::Triangle;
using Stored = TileStore::StoredTriangle;

constexpr MaterialCode concrete = to_code(barriers::BarrierMaterial::concrete);
// A railing at the edge of a bridge (ZTV-ING, part 8: 1.00 m), of bars 2 cm thick and 12 cm apart
// as other fences here.
constexpr barriers::BarrierKind railing{"railing", 1.0, 0, barriers::BarrierMaterial::painted_metal,
                                        0.8};

glm::dvec3 lowered(const glm::dvec3& p) {
  return {p.x, p.y, p.z - bridges::deck_m};
}

// Returns the top, cut along the outlines of what covers it, and bare concrete elsewhere.
std::vector<Triangle> cover_top(const DeckSurface& surface, const ground_cover::Cover& cover,
                                BridgesReport& report) {
  const glm::dvec3 origin = surface.points.front();
  std::vector<Stored> stored;
  for (const auto& t : surface.triangles) {
    Stored triangle{{}, to_code(BakeMaterial::terrain), no_id, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = surface.points[t[k]] - origin;
      triangle.corners[k] = glm::vec3(glm::dvec3(p.x, p.z, -p.y));
    }
    stored.push_back(triangle);
  }
  CoverCounts counts;
  cover_ground(cover, origin, stored, counts);
  report.bare_decks += counts.uncut_tiles;
  std::vector<Triangle> out;
  for (const Stored& triangle : stored) {
    const bool bare = triangle.material == to_code(BakeMaterial::terrain);
    Triangle made{{}, bare ? concrete : triangle.material, NodeKind::bridge};
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p(triangle.corners[k]);
      made.corners[k] = origin + glm::dvec3(p.x, -p.z, p.y);
    }
    out.push_back(made);
  }
  return out;
}

void add_body(const DeckSurface& surface, std::vector<Triangle>& out) {
  const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    out.push_back({{a, b, c}, concrete, NodeKind::bridge});
  };
  const auto& p = surface.points;
  for (const auto& t : surface.triangles) add(lowered(p[t[2]]), lowered(p[t[1]]), lowered(p[t[0]]));
  for (const DeckSurface::Edge& edge : surface.edges) {
    const glm::dvec3 &a = p[edge.from], &b = p[edge.to];
    add(lowered(a), lowered(b), b);
    add(lowered(a), b, a);
  }
}

// Returns the lines of edges along which a deck has a railing.
std::vector<barriers::BarrierLine> find_railings(const DeckSurface& surface) {
  std::map<std::uint32_t, std::uint32_t> next;
  std::map<std::uint32_t, int> reached;
  for (const DeckSurface::Edge& edge : surface.edges) {
    if (edge.is_end) continue;
    next[edge.from] = edge.to;
    ++reached[edge.to];
  }
  std::vector<barriers::BarrierLine> lines;
  for (const bool rings : {false, true})  // what is left when lines with a beginning are gone
    while (true) {
      auto first = next.begin();
      while (!rings && first != next.end() && reached.contains(first->first)) ++first;
      if (first == next.end()) break;
      barriers::BarrierLine line{railing, {surface.points[first->first]}};
      for (auto at = first; at != next.end();) {
        const std::uint32_t to = at->second;
        next.erase(at);
        line.points.push_back(surface.points[to]);
        at = next.find(to);
      }
      lines.push_back(std::move(line));
    }
  return lines;
}

double find_area_m2(const DeckSurface& surface) {
  double area_m2 = 0;
  for (const auto& t : surface.triangles) {
    const glm::dvec3 a = surface.points[t[0]], u = surface.points[t[1]] - a,
                     v = surface.points[t[2]] - a;
    area_m2 += (u.x * v.y - u.y * v.x) / 2;
  }
  return area_m2;
}

}  // namespace

void add_bridge_models(const CityBridges& bridges, SceneTiles& tiles, BridgesReport& report) {
  report.has_bridges = bridges.built();
  report.found = bridges.decks().report();
  for (const auto& [layer, cover] : bridges.covers())
    for (const DeckSurface& surface : make_deck_surfaces(bridges.decks(), layer)) {
      std::vector<Triangle> triangles = cover_top(surface, cover, report);
      add_body(surface, triangles);
      report.triangles += triangles.size();
      report.deck_m2 += find_area_m2(surface);
      tiles.add_bridge(triangles);
      for (const barriers::BarrierLine& line : find_railings(surface)) {
        const std::vector<barriers::Corners> shape = barriers::make_shape(line);
        report.triangles += shape.size();
        tiles.add_barrier(shape, line.kind.material);
      }
    }
}

}  // namespace nightcity::bake
