#include <array>
#include <glm/geometric.hpp>
#include <map>

#include "formats/light_file.h"
#include "tools/lights/light_statistics.h"
#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {
namespace {

// Counts kinds of vehicle and trips, and how many vehicles are on the road on average in each hour
// of the night.
Inspection inspect_traffic(const TrafficContent& traffic) {
  std::map<std::string, std::size_t> lamps;
  for (const Light& light : traffic.vehicle_lights)
    ++lamps[name_of(static_cast<LightFamily>(light.id))];
  double metres = 0, seconds = 0;
  std::size_t brakings = 0;
  std::array<double, 24> on_road{};
  for (const Trip& trip : traffic.trips) {
    const auto knots = traffic.knots.subspan(trip.first_knot, trip.knot_count);
    const double duration = double{knots.back().time_s};
    seconds += duration;
    for (std::size_t hour = 0; hour < on_road.size(); ++hour)
      if (traffic.cycle.density[hour] > trip.rank)
        on_road[hour] += duration / double{traffic.cycle.cycle_s};
    for (std::size_t n = 1; n < knots.size(); ++n) {
      metres += double{glm::distance(knots[n].position, knots[n - 1].position)};
      brakings += (knots[n].pose & KNOT_BRAKING) != 0 && (knots[n - 1].pose & KNOT_BRAKING) == 0;
    }
  }
  return {{"cycle_s", traffic.cycle.cycle_s},
          {"vehicle_kinds", traffic.vehicles.size()},
          {"vehicle_lights", lamps},
          {"trips", traffic.trips.size()},
          {"knots", traffic.knots.size()},
          {"km_a_cycle", metres / 1000},
          {"mean_speed_m_s", seconds > 0 ? metres / seconds : 0},
          {"brakings_a_cycle", brakings},
          {"vehicles_by_hour_from_noon", on_road}};
}

}  // namespace

Inspection inspect_lights(const std::filesystem::path& file) {
  const LightFile lights = LightFile::open(file);
  lights.verify();
  Inspection result = make_empty_inspection("lights");
  const Georeference& geo = lights.georeference();
  std::map<std::string, std::size_t> kinds;
  std::map<std::string, double> flux;
  std::map<std::string, std::map<std::string, std::size_t>> sources;
  std::size_t scheduled = 0;
  for (const auto& [name, family] : lights::count_lights(lights).families) {
    result["lights"][name] = family.count;
    flux[name] = family.flux_lm;
    scheduled += family.count - family.always_on;
    for (const auto& [kind, count] : family.kinds) kinds[kind] += count;
    for (const auto& [value, counts] : family.sources)
      for (const auto& [source, count] : counts) sources[value][source] += count;
  }
  Bounds bounds;
  for (const Light& light : lights.lights()) bounds.add(geo.from_model(glm::dvec3(light.position)));
  if (!geo.crs.empty()) result["crs"] = geo.crs;
  result["bbox"] = bounds.to_json(3);
  result["origin"] = {geo.origin.x, geo.origin.y, geo.origin.z};
  result["kinds"] = kinds;
  result["flux_lm"] = flux;
  result["profiles"] = lights.profiles().size();
  result["schedules"] = lights.schedules().size();
  result["scheduled"] = scheduled;
  result["value_sources"] = sources;
  if (const TrafficContent traffic = lights.traffic(); !traffic.trips.empty())
    result["traffic"] = inspect_traffic(traffic);
  result["sources"] = geo.sources;
  result["licences"] = geo.licences;
  return result;
}

}  // namespace nightcity::nightbake
