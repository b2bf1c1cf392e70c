#include "tools/streets/road_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/ring_area.h"

namespace nightcity::streets {
namespace {

constexpr double smallest_m2 = 0.01;  // in plan: less is an upright kerb
constexpr double farthest_m = 1e8;

enum class AreaUse { unsaid, vehicles, others };

/// Function codes of traffic areas. Up to two digits: CityGML 2.0, annex C (1 driving lane, 9 rail
/// and road combined, 14-20 markings and crossings, 24 filtering lane, 32 bus lay-by, 33-36
/// motorway and its lanes; the rest are for others). Four digits: PLATEAU's TrafficArea_function
/// (10xx carriageway, its lanes, crossings and level crossings, 1130 service carriageway; 2xxx
/// pavements, 6000 and 7000 parking).
AreaUse use_of(int function) {
  if (function <= 0 || function >= 9000) return AreaUse::unsaid;
  if (function >= 1000) {
    if (function == 1050) return AreaUse::others;  // tramway
    return function < 2000 ? AreaUse::vehicles : AreaUse::others;
  }
  if (function == 1 || function == 9 || function == 20 || function == 24 || function == 32)
    return AreaUse::vehicles;
  if ((function >= 14 && function <= 17) || (function >= 33 && function <= 36))
    return AreaUse::vehicles;
  return AreaUse::others;
}

bool in_plan(const city::Ring& ring, PlanRing& plan) {
  for (const glm::dvec3& p : ring) {
    if (!(std::abs(p.x) < farthest_m && std::abs(p.y) < farthest_m)) return false;
    plan.emplace_back(p.x, p.y);
  }
  return std::abs(signed_area(plan)) >= smallest_m2;
}

}  // namespace

const char* highway_of(std::string_view function) {
  // CityGML 2.0, annex C: 1010 motorway, 1020 national, 1030 land and 1040 district road, 1060 main
  // through-road. PLATEAU's Road_function: 1 national expressway, 2 national, 3 prefectural road.
  // Municipal roads (1050 and 4) have all widths, so their width decides.
  static constexpr std::array<std::pair<std::string_view, const char*>, 8> rows = {{
      {"1010", "motorway"},
      {"1020", "primary"},
      {"1030", "secondary"},
      {"1040", "tertiary"},
      {"1060", "primary"},
      {"1", "motorway"},
      {"2", "primary"},
      {"3", "secondary"},
  }};
  // A text may hold several codes, separated by semicolons: the first that is known decides.
  while (!function.empty()) {
    const std::size_t end = std::min(function.find(';'), function.size());
    for (const auto& [code, highway] : rows)
      if (function.substr(0, end) == code) return highway;
    function.remove_prefix(std::min(end + 1, function.size()));
  }
  return nullptr;
}

void RoadSurfaces::add(const city::CityObject& object) {
  if (object.type != city::ObjectType::road) return;
  const char* highway = highway_of(object.function);
  if (!highway) highway = highway_of(object.usage);
  if (highway && std::string_view(highway) == "motorway") {
    // Expressways stand on piers above other streets, but models draw them on the ground. In plan
    // the two would merge.
    left_out_["of motorways"] += object.polygons.size();
    return;
  }
  const auto said = [](const city::Polygon& polygon) {
    return polygon.surface == city::SurfaceType::traffic_area ? use_of(polygon.area_function)
                                                              : AreaUse::unsaid;
  };
  const bool carriageways =
      std::any_of(object.polygons.begin(), object.polygons.end(),
                  [&](const city::Polygon& polygon) { return said(polygon) == AreaUse::vehicles; });
  for (const city::Polygon& polygon : object.polygons) {
    const AreaUse use = said(polygon);
    if (use == AreaUse::others || polygon.surface == city::SurfaceType::auxiliary_traffic_area ||
        (carriageways && use != AreaUse::vehicles)) {
      ++left_out_["for others than vehicles"];
      continue;
    }
    RoadSurface surface;
    if (!in_plan(polygon.exterior, surface.exterior)) {
      ++left_out_["upright or without area"];
      continue;
    }
    for (const city::Ring& ring : polygon.interiors) {
      PlanRing hole;
      if (in_plan(ring, hole)) surface.interiors.push_back(std::move(hole));
    }
    surface.highway = highway;
    surface.carriageway = carriageways;
    surfaces_.push_back(std::move(surface));
  }
}

}  // namespace nightcity::streets
