// The one table of what a lamp is like where its tags do not say. OSM has a height for 0.3 % of its
// street lamps and a flux for none, so these rows light nearly every scene. The sources are beside
// the rows in lamp_defaults.cpp.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

#include "tools/lights/optics.h"
#include "tools/roads/road_class.h"

namespace nightcity::lights {

/// The lamp beside a road of a class, for all that its tags do not say.
struct RoadLighting {
  const char* highway;  // value of the OSM tag
  roads::RoadTier tier;
  double mounting_m;  // luminous centre above the ground
  double outreach_m;  // from the post towards the road
  double flux_lm;     // out of the luminaire: LED, today's standard
  double cct_k;
  Optic optic;
  const char* target;  // EN 13201-2 class that this flux reaches at the usual spacing
};

/// Returns the row of a road class. Every class of tools/roads has one.
const RoadLighting& find_road_lighting(const roads::RoadClass& road_class);
/// Returns the row of a highway value ("_link" classes have their main class's row); null where no
/// lamp belongs (proposed, construction, raceway, ...).
const RoadLighting* find_road_lighting(std::string_view highway);
/// Returns the row for lamps with no road near: squares and parks.
const RoadLighting& open_space_defaults();
/// Returns the row for lit masts (tower:type=lighting, floodlight): car parks, yards, sports
/// grounds.
const RoadLighting& lighting_mast_defaults();

enum class LampType {
  led,
  high_pressure_sodium,
  low_pressure_sodium,
  mercury,
  metal_halide,
  fluorescent,
  incandescent,
  gas
};

struct LampTypeDefaults {
  const char* name;
  double flux_lm[3];             // out of the luminaire, by RoadTier; 0: the road's own
  double lumen_per_watt;         // out of the luminaire, for tags that give watts
  double cct_k;                  // 0: the road's own
  std::optional<glm::dvec2> xy;  // chromaticity where it is not on the Planckian locus
  bool lantern;                  // comes in a lantern rather than in a street luminaire
};

const LampTypeDefaults& lamp_type_defaults(LampType type);

constexpr double luminous_radius_m = 0.12;  // of a street luminaire's opening
constexpr double lantern_radius_m = 0.18;
constexpr double gas_lumen_per_flame = 100;  // lamp_flames=4 and 9 are common: 400 and 900 lm
constexpr double wall_mounting_m = 5.0;      // brackets on facades
constexpr double bollard_mounting_m = 0.9;
constexpr double nearest_road_m = 40;  // farther away a lamp belongs to no road

}  // namespace nightcity::lights
