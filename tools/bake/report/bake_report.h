// What a bake did, in numbers: printed at its end and left beside the scene as bake_report.json.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/scene_file.h"
#include "tools/bake/city/ground_builder.h"
#include "tools/bake/city/model_streets.h"
#include "tools/bake/report/light_report.h"
#include "tools/city/city_reader.h"
#include "tools/layout/layout.h"
#include "tools/mesh/triangle_mesh.h"
#include "tools/traffic/traffic.h"

namespace nightcity {

struct BakeReport {
  ReadReport read;
  MeshReport mesh;
  std::map<std::string, std::size_t> objects;    // by type
  std::map<std::string, std::size_t> triangles;  // by material, as written
  std::map<std::string, std::size_t>
      left_out;                  // objects not baked, by reason; triangles where it says so
  std::vector<std::string> crs;  // descriptions of the frames
  GroundReport ground;
  std::size_t relief_points = 0;  // mass points and vertices of break lines
  std::size_t colours = 0;        // materials the model itself names
  std::size_t draped = 0;         // triangles without heights laid onto it
  StreetReport streets;           // of the model, where the map has none
  LampReport lamps;
  WindowReport windows;
  std::size_t schedules = 0;    // different ones in city.lights
  layout::LayoutReport layout;  // of lamps where the map has none
  std::optional<traffic::TrafficReport> traffic;
  SceneWriter::Statistics scene;
  std::uint64_t scene_bytes = 0, lights_bytes = 0, input_bytes = 0;
  struct Stage {
    std::string name;
    double seconds = 0;
    double peak_mb = 0;  // of memory, from the program's start to the stage's end
  };
  std::vector<Stage> stages;  // in order
};

nlohmann::json to_json(const BakeReport& report);
std::string to_text(const BakeReport& report);

}  // namespace nightcity
