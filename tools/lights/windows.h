// Lit windows of a city: emitter rectangles with a luminance, a colour and the times of one night.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "formats/georeference.h"
#include "formats/light_file.h"
#include "tools/citygml/city_model.h"
#include "tools/lights/facades.h"
#include "tools/lights/lamps.h"
#include "tools/lights/occupancy.h"
#include "tools/lights/wall_index.h"

namespace nightcity {

struct WindowOptions {
  std::uint64_t seed = 1;
  double obstacle_m = 0.5;  // nothing may stand this near before a window
};

struct LitRectangle {
  glm::dvec3 centre{0};  // a finger before the wall, so that the wall does not shade it; E, N, H, m
  glm::vec3 normal{0}, along{0};
  float half_width = 0, half_height = 0;
  float luminance_cd_m2 = 0, cct_k = 0;
  std::uint32_t schedule = 0;  // into WindowSet::schedules
  std::uint32_t id = 0;
  LightProvenance provenance;

  /// Lambertian, one-sided: flux = pi L A.
  double flux_lm() const;
};

struct WindowSet {
  std::vector<LitRectangle> windows;
  std::vector<NightSchedule> schedules;  // each once, sorted
  std::map<std::string, std::size_t>
      dropped;  // reason and count: "something before it", "below the ground", "dark all night"
  std::map<std::string, std::map<std::string, std::size_t>> sources;  // as LampSet's
};

/// Takes buildings one by one, then looks at what stands before each window. The same building, id and seed
/// give the same windows, whatever else is in the city (but for what stands before them).
class WindowLayout {
 public:
  explicit WindowLayout(const WindowOptions& options);

  /// Coordinates E, N, H in metres; walls as SurfaceType::wall.
  void add(const CityObject& building);
  /// `ground` may be empty: then nothing is known to be below it.
  WindowSet finish(const HeightAt& ground) &&;

 private:
  void light(const CityObject& building, const std::vector<WindowPlace>& places, KnownUse use);
  bool clear(const LitRectangle& window) const;

  WindowOptions options_;
  WallIndex walls_;
  FacadeReport facades_;
  WindowSet set_;
  std::vector<NightSchedule> schedule_of_;  // of set_.windows, until they are numbered
  std::unordered_set<std::uint32_t> ids_;
};

/// The window as a light of model space, on always: whoever bakes one moment asks its schedule first.
Light to_light(const LitRectangle& window, const Georeference& georeference);

}  // namespace nightcity
