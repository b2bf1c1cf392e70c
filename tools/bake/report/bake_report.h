// The figures of a bake, printed at its end and written beside the scene as bake_report.json.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene_writer.h"
#include "tools/bake/city/map_gaps.h"
#include "tools/bake/report/barrier_report.h"
#include "tools/bake/report/bridge_report.h"
#include "tools/bake/report/city_report.h"
#include "tools/bake/report/cover_report.h"
#include "tools/bake/report/light_report.h"
#include "tools/bake/report/places_report.h"
#include "tools/bake/report/scene_report.h"
#include "tools/bake/report/stage_clock.h"
#include "tools/bake/report/steps_report.h"
#include "tools/bake/report/street_report.h"
#include "tools/traffic/traffic.h"

namespace nightcity::bake {

struct BakeReport {
  CityReport city;
  GroundReport ground;
  SceneTilesReport tiles;
  GapReport gaps;
  std::map<std::string, std::size_t> skipped_of_map;  // elements, by reason; also reasons of none
  CoverReport cover;
  BridgesReport bridges;
  BarriersReport barriers;
  FlightsReport steps;
  HorizonReport horizon;
  TreeReport trees;
  StreetReport streets;  // of the model, where the map has none
  PlacesReport places;
  LightsReport lights;
  std::optional<traffic::TrafficReport> traffic;
  SceneWriter::Statistics scene;
  HierarchyReport hierarchies;
  std::vector<std::string> crs;  // descriptions of the frames
  std::uint64_t scene_bytes = 0, lights_bytes = 0, input_bytes = 0;
  std::vector<StageCost> stages;  // in order

  /// Returns what was not baked, by reason: objects, and triangles where the reason says so.
  std::map<std::string, std::size_t> left_out() const;
};

nlohmann::json to_json(const BakeReport& report);
std::string to_text(const BakeReport& report);

}  // namespace nightcity::bake
