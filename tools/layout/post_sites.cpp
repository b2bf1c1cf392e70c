#include "tools/layout/post_sites.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "tools/layout/layout_design.h"
#include "tools/line.h"

namespace nightcity::layout {
namespace {

constexpr double building_clearance_m = 0.5, kerb_clearance_m = 0.1, step_m = 0.1;
constexpr double carriageway_clearance_m = 0.2;
constexpr double sample_m = 2;

}  // namespace

PostSites::PostSites(const streets::StreetNetwork& network,
                     const std::vector<const osm::OsmWay*>& unlit,
                     const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
                     const place::InsideBuilding& inside)
    : network_(network), height_at_(height_at), inside_(inside) {
  // Paths are no obstacles, because lamps stand on pavements.
  for (const streets::Street& street : network.streets)
    add_carriageway(
        lighting_of(street).tier == roads::RoadTier::path ? std::vector<glm::dvec2>() : street.line,
        street.road.width_m);
  for (const osm::OsmWay* way : unlit) {
    const auto road = roads::read_carriageway(way->tags);
    if (!road || road->road_class->tier == roads::RoadTier::path) continue;
    std::vector<glm::dvec2> line;
    for (const glm::dvec2& lon_lat : way->lon_lat) {
      const glm::dvec2 p = to_frame(lon_lat);
      if (std::isfinite(p.x) && std::isfinite(p.y)) line.push_back(p);
    }
    add_carriageway(line, road->width_m);
  }
}

void PostSites::add_carriageway(const std::vector<glm::dvec2>& line, double width_m) {
  constexpr double longest_m = 1e5;
  const auto number = static_cast<std::uint32_t>(half_widths_m_.size());
  half_widths_m_.push_back(width_m / 2);
  if (!line.empty()) widest_half_m_ = std::max(widest_half_m_, width_m / 2);
  for (std::size_t n = 0; n + 1 < line.size(); ++n) {
    const double length = glm::distance(line[n], line[n + 1]);
    if (!(length <= longest_m)) continue;
    const int parts = std::max(1, static_cast<int>(std::ceil(length / sample_m)));
    for (int part = 0; part <= parts; ++part)
      carriageways_.add(glm::mix(line[n], line[n + 1], static_cast<double>(part) / parts), number);
  }
}

bool PostSites::near_other_carriageway(std::size_t street, const glm::dvec2& p,
                                       double clearance_m) const {
  return carriageways_.any_near(
      p, widest_half_m_ + clearance_m, [&](const glm::dvec2& q, std::uint32_t n) {
        return n != street && glm::distance(p, q) < half_widths_m_[n] + clearance_m;
      });
}

// A street may bend back to a place beside it, or cross itself.
bool PostSites::is_in_carriageway(const streets::Street& street, const glm::dvec2& p) const {
  for (std::size_t n = 0; n + 1 < street.line.size(); ++n)
    if (find_distance(p, street.line[n], street.line[n + 1]) < street.road.width_m / 2) return true;
  return false;
}

bool PostSites::clear_of_buildings(const glm::dvec2& p) const {
  if (!inside_) return true;
  if (inside_(p)) return false;
  for (int n = 0; n < 16; ++n) {
    const double angle = std::numbers::pi * n / 8;
    if (inside_(p + building_clearance_m * glm::dvec2(std::cos(angle), std::sin(angle))))
      return false;
  }
  return true;
}

std::optional<PostSite> PostSites::beside(std::size_t street, double along_m, int side,
                                          SiteFault& fault) const {
  const streets::Street& road = network_.streets[street];
  const streets::Street::Place place = road.place(along_m);
  fault = SiteFault::outside_model;
  if (!height_at_(place.point)) return std::nullopt;
  fault = SiteFault::building;
  if (inside_ && inside_(place.point)) return std::nullopt;  // a passage under a building
  const glm::dvec2 left(-place.along.y, place.along.x);
  const double kerb = road.road.width_m / 2, wanted = kerb + setback_m(lighting_of(road));
  for (double offset = wanted; offset >= kerb + kerb_clearance_m - 1e-9; offset -= step_m) {
    const glm::dvec2 p = place.point + left * (side * offset);
    if (!clear_of_buildings(p)) continue;
    const auto height = height_at_(p);
    fault = !height ? SiteFault::outside_model : SiteFault::carriageway;
    if (!height || is_in_carriageway(road, p) ||
        near_other_carriageway(street, p, carriageway_clearance_m))
      return std::nullopt;
    return PostSite{{p, *height}, along_m, offset, side, offset < wanted};
  }
  return std::nullopt;
}

std::optional<PostSite> PostSites::above(std::size_t street, double along_m,
                                         SiteFault& fault) const {
  const streets::Street::Place place = network_.streets[street].place(along_m);
  fault = SiteFault::outside_model;
  const auto height = height_at_(place.point);
  if (!height) return std::nullopt;
  fault = SiteFault::building;
  if (!clear_of_buildings(place.point)) return std::nullopt;
  return PostSite{{place.point, *height}, along_m, 0, 0, false};
}

}  // namespace nightcity::layout
