#include "tools/lights/lamp_defaults.h"

#include <algorithm>
#include <array>

#include "tools/lights/lighting_class.h"
#include "tools/roads/carriageway.h"

namespace nightcity::lights {
namespace {

// Heights: Global Street Design Guide (NACTO 2016): footways and cycle tracks 3-6 m, narrow streets
// 6-10 m, wide streets 10-12 m; spacing 2.5-3 heights. Outreach: 1-2 m brackets where the post
// stands behind the kerb (CEN/TR 13201-1's worked examples). Colour: 4000 K on main roads, 3000 K
// where people live (EU green public procurement criteria, SWD(2018) 494). Flux, rounded to 100 lm:
// what the class in the last column asks for on an untagged road of width W at a spacing S of three
// heights, E W S / (utilisation x maintenance), with E from lighting_class.h. Mapped lamps have
// such spacings: the median gap is 21 m along Berlin's residential streets and 25 m along secondary
// ones. Luminaires on posts give at least 800 lm; smaller ones are bollards.
constexpr double min_on_posts_lm = 800;

/// Returns the share of a luminaire's flux that reaches a road of this width. It grows with the
/// width over the mounting height (57 % where they are equal, for the street optic of optics.cpp)
/// and is taken to be at most 0.4 for the luminaires of a whole street.
double utilisation(double width_m, double mounting_m) {
  return std::min(0.4, 0.5 * width_m / mounting_m);
}

/// Returns the width in metres that one lamp lights on an untagged road of this class. Two-way
/// roads with more than one lane each way have lamps on both sides, and each side lights its half.
double lit_width_m(const char* highway) {
  const auto carriageway = roads::read_carriageway({{"highway", highway}});
  const bool both_sides = carriageway->lanes[0] > 1 && carriageway->lanes[1] > 1;
  return both_sides ? carriageway->width_m / 2 : carriageway->width_m;
}

struct Row {
  const char* highway;
  double mounting_m, outreach_m, cct_k;
  Optic optic;
  const char* target;
};

constexpr std::array<Row, 20> rows = {{
    {"motorway", 12.0, 2.0, 4000, Optic::street, "M2"},
    {"trunk", 12.0, 2.0, 4000, Optic::street, "M2"},
    {"primary", 10.0, 1.5, 4000, Optic::street, "M3"},
    {"secondary", 9.0, 1.5, 4000, Optic::street, "M4"},
    {"tertiary", 8.0, 1.0, 3500, Optic::street, "M5"},
    {"unclassified", 7.0, 1.0, 3000, Optic::street, "P4"},
    {"residential", 6.0, 0.8, 3000, Optic::street, "P4"},
    {"road", 6.0, 0.8, 3000, Optic::street, "P4"},
    {"living_street", 5.0, 0.5, 3000, Optic::street, "P5"},
    {"service", 6.0, 0.5, 3000, Optic::street, "P5"},
    {"busway", 9.0, 1.5, 4000, Optic::street, "M4"},
    {"pedestrian", 4.5, 0.0, 3000, Optic::lantern, "P3"},
    {"footway", 4.0, 0.0, 3000, Optic::lantern, "P5"},
    {"path", 4.0, 0.0, 3000, Optic::lantern, "P5"},
    {"steps", 4.0, 0.0, 3000, Optic::lantern, "P5"},
    {"cycleway", 5.0, 0.3, 3000, Optic::street, "P5"},
    {"bridleway", 4.0, 0.0, 3000, Optic::lantern, "P5"},
    {"track", 5.0, 0.3, 3000, Optic::street, "P5"},
    {"platform", 4.5, 0.0, 4000, Optic::lantern, "P3"},
    {"corridor", 3.5, 0.0, 4000, Optic::lantern, "P5"},
}};

RoadLighting to_road_lighting(const Row& row) {
  const roads::RoadClass& road = *roads::find_road_class(row.highway);
  const double width_m = lit_width_m(row.highway);
  const double average_lx = lighting_class(row.target)->average_lx;
  const double needed = average_lx * width_m * 3 * row.mounting_m /
                        (utilisation(width_m, row.mounting_m) * maintenance_factor);
  const auto hundreds = static_cast<int>(needed / 100 + 0.5);
  const double flux = hundreds * 100 > min_on_posts_lm ? hundreds * 100 : min_on_posts_lm;
  return {row.highway, road.tier, row.mounting_m, row.outreach_m,
          flux,        row.cct_k, row.optic,      row.target};
}

const std::array<RoadLighting, rows.size()>& road_lighting() {
  static const auto table = [] {
    std::array<RoadLighting, rows.size()> made;
    std::transform(rows.begin(), rows.end(), made.begin(), to_road_lighting);
    return made;
  }();
  return table;
}

constexpr RoadLighting open_space = {"",   roads::RoadTier::path, 4.5, 0, 2500,
                                     3000, Optic::lantern,        "P4"};
constexpr RoadLighting mast = {"",   roads::RoadTier::main, 15, 0.5, 30000,
                               4000, Optic::floodlight,     ""};

// Lamp flux by makers' standard wattages (HPS 150/70/50 W: 17,500/6,600/4,400 lm; SOX 90/55/35 W:
// 13,000/7,800/4,600; mercury 250/125/80 W: 12,700/6,200/3,600; metal halide 150/70/35 W:
// 14,000/6,600/3,300; compact fluorescent 2x36/36/18 W) times a light output ratio of 0.75 (0.65
// for lanterns). LED: the road's own flux, 120 lm/W. Gas: 300-900 lm a lantern. Chromaticity:
// high-pressure sodium, mercury and metal halide as CIE 15:2004 HP1 and HP4 and a coated mercury
// lamp; low-pressure sodium is the 589 nm line's point on the spectral locus. They are not black
// bodies: 2000 K white is not the colour of sodium.
const std::array<LampTypeDefaults, 8> lamp_types = {{
    {"LED", {0, 0, 0}, 120, 0, std::nullopt, false},
    {"high-pressure sodium", {13100, 4950, 3300}, 75, 1959, glm::dvec2(0.5330, 0.4150), false},
    {"low-pressure sodium", {9750, 5850, 3450}, 105, 1800, glm::dvec2(0.5693, 0.4298), false},
    {"mercury", {9500, 4650, 2700}, 38, 4000, glm::dvec2(0.390, 0.390), false},
    {"metal halide", {10500, 4950, 2450}, 70, 4002, glm::dvec2(0.3812, 0.3797), false},
    {"fluorescent", {4300, 2150, 900}, 45, 4000, std::nullopt, false},
    {"incandescent", {1500, 1000, 650}, 9, 2700, std::nullopt, true},
    {"gas", {900, 600, 400}, 1, 2800, std::nullopt, true},
}};

}  // namespace

const RoadLighting& find_road_lighting(const roads::RoadClass& road_class) {
  const RoadLighting* row = find_road_lighting(road_class.highway);
  return row ? *row : open_space_defaults();
}

const RoadLighting* find_road_lighting(std::string_view highway) {
  const std::string_view main = roads::main_highway(highway);
  for (const RoadLighting& row : road_lighting())
    if (row.highway == main) return &row;
  return nullptr;
}

const RoadLighting& open_space_defaults() {
  return open_space;
}
const RoadLighting& lighting_mast_defaults() {
  return mast;
}

const LampTypeDefaults& lamp_type_defaults(LampType type) {
  return lamp_types[static_cast<std::size_t>(type)];
}

}  // namespace nightcity::lights
