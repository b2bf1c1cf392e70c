#include "tools/roads/road_class.h"

#include <array>

namespace nightcity::roads {
namespace {

// Widths: 3.5 m lanes on main roads, 3.0 m elsewhere.
constexpr std::array<RoadClass, 20> classes = {{
    {"motorway", RoadTier::main, 11.5},      {"trunk", RoadTier::main, 10.5},
    {"primary", RoadTier::main, 10.0},       {"secondary", RoadTier::main, 8.5},
    {"tertiary", RoadTier::local, 7.0},      {"unclassified", RoadTier::local, 6.0},
    {"residential", RoadTier::local, 6.0},   {"road", RoadTier::local, 6.0},
    {"living_street", RoadTier::local, 5.5}, {"service", RoadTier::local, 4.0},
    {"busway", RoadTier::main, 6.5},         {"pedestrian", RoadTier::path, 7.0},
    {"footway", RoadTier::path, 2.5},        {"path", RoadTier::path, 2.0},
    {"steps", RoadTier::path, 2.5},          {"cycleway", RoadTier::path, 2.5},
    {"bridleway", RoadTier::path, 2.5},      {"track", RoadTier::path, 3.0},
    {"platform", RoadTier::path, 3.0},       {"corridor", RoadTier::path, 2.5},
}};

}  // namespace

const RoadClass* find_road_class(std::string_view highway) {
  constexpr std::string_view link = "_link";
  if (highway.ends_with(link)) highway.remove_suffix(link.size());
  for (const RoadClass& row : classes)
    if (row.highway == highway) return &row;
  return nullptr;
}

}  // namespace nightcity::roads
