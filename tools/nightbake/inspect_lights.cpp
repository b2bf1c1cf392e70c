#include <array>
#include <glm/geometric.hpp>
#include <map>

#include "formats/light_file.h"
#include "tools/nightbake/inspect.h"

namespace nightcity {
namespace {

const char* name_of(LightFamily family) {
  switch (family) {
    case LightFamily::lamp:
      return "lamp";
    case LightFamily::window:
      return "window";
    case LightFamily::headlamp:
      return "headlamp";
    case LightFamily::tail_lamp:
      return "tail_lamp";
    case LightFamily::other:
      break;
  }
  return "other";
}

const char* name_of(ValueSource source) {
  switch (source) {
    case ValueSource::tag:
      return "tag";
    case ValueSource::attribute:
      return "attribute";
    case ValueSource::rule:
      return "rule";
    case ValueSource::standard:
      return "standard";
    case ValueSource::unknown:
      break;
  }
  return "unknown";
}

/// What drives: kinds and trips, and how many are on the road on average in each hour of the night.
Inspection inspect_traffic(const TrafficContent& traffic) {
  std::map<std::string, std::size_t> lamps;
  for (const Light& light : traffic.vehicle_lights) ++lamps[name_of(static_cast<LightFamily>(light.id))];
  double metres = 0, seconds = 0;
  std::size_t brakings = 0;
  std::array<double, 24> on_road{};
  for (const Trip& trip : traffic.trips) {
    const auto knots = traffic.knots.subspan(trip.first_knot, trip.knot_count);
    const double duration = double{knots.back().time_s};
    seconds += duration;
    for (std::size_t hour = 0; hour < on_road.size(); ++hour)
      if (traffic.cycle.density[hour] > trip.rank) on_road[hour] += duration / double{traffic.cycle.cycle_s};
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
  Inspection result = empty_inspection("lights");
  const Georeference& geo = lights.georeference();
  std::map<std::string, std::size_t> families, kinds;
  std::map<std::string, double> flux;
  std::map<std::string, std::map<std::string, std::size_t>> sources;
  Bounds bounds;
  std::size_t scheduled = 0;
  for (std::size_t i = 0; i < lights.lights().size(); ++i) {
    const Light& light = lights.lights()[i];
    const LightProvenance& origin = lights.provenance()[i];
    const std::string family = name_of(static_cast<LightFamily>(origin.family));
    ++families[family];
    flux[family] += double{light.flux_lm};
    ++kinds[(light.kind_profile & 0xFFu) == LIGHT_SPHERE ? "sphere" : "rectangle"];
    if (light.schedule != LIGHT_ALWAYS_ON) ++scheduled;
    bounds.add(geo.from_model(glm::dvec3(light.position)));
    ++sources["position"][name_of(origin.position)];
    ++sources["height"][name_of(origin.height)];
    ++sources["flux"][name_of(origin.flux)];
    ++sources["colour"][name_of(origin.colour)];
    ++sources["profile"][name_of(origin.profile)];
  }
  for (const auto& [family, count] : families) result["lights"][family] = count;
  if (!geo.crs.empty()) result["crs"] = geo.crs;
  result["bbox"] = bounds.json(3);
  result["origin"] = {geo.origin.x, geo.origin.y, geo.origin.z};
  result["kinds"] = kinds;
  result["flux_lm"] = flux;
  result["profiles"] = lights.profiles().size();
  result["scheduled"] = scheduled;
  result["value_sources"] = sources;
  if (const TrafficContent traffic = lights.traffic(); !traffic.trips.empty())
    result["traffic"] = inspect_traffic(traffic);
  result["sources"] = geo.sources;
  result["licences"] = geo.licences;
  return result;
}

}  // namespace nightcity
