#include "tools/bake/scene/bridge_models.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/bake/scene/cover_ground.h"
#include "tools/bake/scene/deck_surface.h"
#include "tools/barriers/barrier_shape.h"
#include "tools/ground_cover/measured_line.h"

namespace nightcity::bake {
namespace {

using Triangle = TileStore::Triangle;
using Stored = TileStore::StoredTriangle;

constexpr MaterialCode deck_material = to_code(barriers::BarrierMaterial::concrete);
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
    Stored triangle{{}, to_code(BakeMaterial::terrain), no_id, 0, 0};
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
    Triangle made{{}, bare ? deck_material : triangle.material, NodeKind::bridge};
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
    out.push_back({{a, b, c}, deck_material, NodeKind::bridge});
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

// Piers stand as far apart as the span that the deck's thickness is for, and have a thickness and
// a share of the deck's width that are assumptions.
constexpr double span_m = 20 * bridges::deck_m, pier_m = 0.8, pier_share = 0.6;
constexpr double min_pier_m = 1.5;   // a lower deck needs none
constexpr double pier_step_m = 0.5;  // its foot is looked at this often, along both of its sides
constexpr double in_deck_m = 0.2;    // a pier reaches into the deck, which may slope

// Returns whether a pier may stand on what covers the ground: neither where one drives or walks nor
// on tracks.
bool may_stand_on(const ground_cover::Surface* surface) {
  using ground_cover::GroundKind;
  if (!surface) return true;
  for (const GroundKind kind :
       {GroundKind::grass, GroundKind::scrub, GroundKind::woodland, GroundKind::farmland,
        GroundKind::soil, GroundKind::sand, GroundKind::water})
    if (surface->kind == kind) return !surface->marked;
  return false;
}

// Returns a pier below a place of a deck; none where the deck is low, or where all of it cannot
// stand on open ground.
std::optional<barriers::BarrierLine> find_pier(const City& city, const bridges::Deck& deck,
                                               const ground_cover::MeasuredLine& along, double s) {
  const double soffit_m = deck.height_at(s) - bridges::deck_m, half_m = pier_share * deck.half_m;
  const place::HeightAt height_at = city.height_at();
  const place::InsideBuilding inside = city.inside_footprint();
  barriers::BarrierLine pier{{"pier", 0, pier_m, barriers::BarrierMaterial::concrete}, {}};
  double lowest_m = soffit_m;
  const double steps = std::ceil(2 * half_m / pier_step_m);
  for (double k = 0; k <= steps; ++k)
    for (const double ahead_m : {-pier_m / 2, pier_m / 2}) {
      const glm::dvec2 place = along.find_beside(s + ahead_m, half_m * (2 * k / steps - 1));
      const auto ground = height_at(place);
      if (!ground || soffit_m - *ground < min_pier_m || (inside && inside(place)) ||
          !may_stand_on(city.cover().surface_at(place)))
        return std::nullopt;
      // Nor on a bridge below, or through one.
      const auto lowest = city.bridges().decks().find_soffit({place, *ground});
      if (lowest && *lowest < soffit_m - in_deck_m) return std::nullopt;
      lowest_m = std::min(lowest_m, *ground);
    }
  for (const double left_m : {-half_m, half_m})
    pier.points.emplace_back(along.find_beside(s, left_m), 0);
  for (glm::dvec3& p : pier.points) p.z = lowest_m;
  pier.kind.height_m = soffit_m + in_deck_m - lowest_m;
  return pier;
}

std::vector<barriers::BarrierLine> find_piers(const City& city) {
  std::vector<barriers::BarrierLine> piers;
  for (const bridges::Deck& deck : city.bridges().decks().decks()) {
    const ground_cover::MeasuredLine along(deck.line);
    const double spans = std::ceil(deck.length_m() / span_m);
    for (double n = 1; n < spans; ++n)
      if (auto pier = find_pier(city, deck, along, deck.length_m() * n / spans))
        piers.push_back(std::move(*pier));
  }
  return piers;
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

void add_bridge_models(const City& city, SceneTiles& tiles, BridgesReport& report) {
  const CityBridges& bridges = city.bridges();
  const auto add = [&](const barriers::BarrierLine& line) {
    const std::vector<barriers::Corners> shape = barriers::make_shape(line);
    report.triangles += shape.size();
    tiles.add_barrier(shape, line.kind.material);
  };
  report.has_bridges = bridges.built();
  report.found = bridges.decks().report();
  for (const auto& [layer, cover] : bridges.covers())
    for (const DeckSurface& surface : make_deck_surfaces(bridges.decks(), layer)) {
      std::vector<Triangle> triangles = cover_top(surface, cover, report);
      add_body(surface, triangles);
      report.triangles += triangles.size();
      report.deck_m2 += find_area_m2(surface);
      tiles.add_bridge(triangles);
      for (const barriers::BarrierLine& line : find_railings(surface)) add(line);
    }
  for (const barriers::BarrierLine& pier : find_piers(city)) {
    add(pier);
    ++report.piers;
  }
}

}  // namespace nightcity::bake
