// Windows of a city that have light at some time of the night: emitter rectangles with a luminance, a colour
// and the times of one night.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/georeference.h"
#include "formats/light_file.h"
#include "tools/city/city_model.h"
#include "tools/lights/facades.h"
#include "tools/lights/night_schedule.h"
#include "tools/lights/occupancy.h"
#include "tools/lights/wall_index.h"
#include "tools/place/site.h"

namespace nightcity {

struct WindowOptions {
  std::uint64_t seed = 1;
  double obstacle_m = 0.5;  // nothing may stand this near before a window
  UseAt use_at;             // the map's word on a building's use, where the model has none
};

struct LitRectangle {
  glm::dvec3 centre{0};  // a finger before the wall, so that the wall does not shade it; E, N, H, m
  glm::vec3 normal{0}, along{0};
  float half_width = 0, half_height = 0;
  float luminance_cd_m2 = 0, cct_k = 0;
  NightSchedule hours;
  std::uint32_t id = 0;
  LightProvenance provenance;

  /// Lambertian, one-sided: flux = pi L A.
  double flux_lm() const;
};

struct WindowReport {
  std::size_t placed = 0;
  double flux_lm = 0;  // of all of them together, lit or not
  std::map<std::string, std::size_t>
      dropped;  // reason and count: "something before it", "below the ground", "dark all night"
  std::map<std::string, std::map<std::string, std::size_t>> sources;  // as LampSet's
  struct Use {
    std::size_t placed = 0;
    HourCounts lit{};
  };
  std::map<std::string, Use> by_use;  // name of the building's use
};

/// Takes buildings one by one, then looks at what stands before each window. The same building, id and seed
/// give the same windows, whatever else is in the city (but for what stands before them). Windows and walls
/// wait on disk in between, so memory does not grow with the city.
class WindowLayout {
 private:
  struct Record {
    LitRectangle window;
    std::uint32_t owner;  // as WallIndex knows it
    BuildingUse use;
  };

 public:
  /// Keeps scratch files beside `scratch`. Throws Error where it cannot be made.
  WindowLayout(const WindowOptions& options, const std::filesystem::path& scratch);

  /// One object's walls and windows, found without regard to any other.
  class Laid {
    friend class WindowLayout;
    std::vector<WallIndex::Upright> walls;
    std::vector<Record> windows;
    std::size_t dark = 0;  // windows that never have light
    FacadeReport facades;
    std::string use;  // of a building, and who says so
  };

  /// The costly part of adding an object: may be asked from many threads. Coordinates E, N, H in metres;
  /// walls as SurfaceType::wall. Windows are laid on buildings; walls of anything else may stand in their
  /// way.
  Laid lay(const CityObject& object) const { return lay(object, 0); }
  /// `laid` is of `object`.
  void add(const CityObject& object, Laid laid);
  void add(const CityObject& object) { add(object, lay(object)); }

  using Inside = std::function<bool(const glm::dvec3&)>;
  using Sink = std::function<void(const LitRectangle&)>;
  /// Hands every window that stays to `sink`, in the order of the buildings. `ground` may be empty: then
  /// nothing is known to be below it. `inside`, where given, tells places (E, N, H) inside buildings. Both
  /// are asked from up to `threads` threads (0 = one a core).
  WindowReport finish(const HeightAt& ground, const Sink& sink, const Inside& inside = {},
                      unsigned threads = 0) &&;

 private:
  Laid lay(const CityObject& object, std::uint64_t piece) const;
  void light(std::uint64_t name, const std::vector<WindowPlace>& places, BuildingUse use,
             Laid& laid) const;
  const char* fault(const Record& record, const HeightAt& ground, const Inside& inside);

  WindowOptions options_;
  ScratchFile pending_;
  WallIndex walls_;
  std::uint32_t owners_ = 0;  // objects so far
  std::string last_id_;
  std::uint64_t piece_ = 0;  // of the building of that id
  FacadeReport facades_;
  WindowReport report_;
};

/// The window as a light of model space; its hours go into `schedules`.
Light to_light(const LitRectangle& window, const Georeference& georeference,
               ScheduleTable& schedules);

}  // namespace nightcity
