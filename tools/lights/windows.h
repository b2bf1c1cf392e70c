// The windows of a city that are lit at some time of the night: emitting rectangles with a
// luminance, a colour and the times of one night.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "formats/georeference.h"
#include "formats/light_file.h"
#include "formats/scratch_file.h"
#include "tools/city/city_model.h"
#include "tools/lights/facades.h"
#include "tools/lights/night_schedule.h"
#include "tools/lights/occupancy.h"
#include "tools/lights/place_lamps.h"
#include "tools/lights/wall_index.h"
#include "tools/place/site.h"

namespace nightcity::lights {

struct WindowOptions {
  std::uint64_t seed = 1;
  double obstacle_m = 0.5;  // nothing may stand this near in front of a window
  std::size_t max_per_building = default_max_windows;
  UseAt use_at;  // a building's use by the map, if the model gives none
};

struct LitRectangle {
  glm::dvec3 centre{
      0};  // 2 cm in front of the wall, so that the wall does not shade it; E, N, H, m
  glm::vec3 normal{0}, along{0};
  float half_width = 0, half_height = 0;
  float luminance_cd_m2 = 0, cct_k = 0;
  NightSchedule hours;
  std::uint32_t id = 0;
  LightProvenance provenance;

  /// Returns the flux of a one-sided Lambertian emitter, pi L A.
  double flux_lm() const;
};

struct WindowReport {
  std::size_t placed = 0;
  std::size_t emitters = 0;  // that stand for them: fewer where windows are grouped
  double flux_lm = 0;        // sum over all windows, as if all were lit
  // Number of windows left out, by reason: "something before it", "below the ground", "dark all
  // night".
  std::map<std::string, std::size_t> left_out;
  std::map<std::string, std::map<std::string, std::size_t>> sources;  // as LampSet's
  struct Use {
    std::size_t placed = 0;
    HourCounts lit{};
  };
  std::map<std::string, Use> by_use;  // name of the building's use
};

/// Takes buildings one by one, then checks what stands in front of each window. The windows of a
/// building follow from its geometry, its id and the seed; the rest of the city only matters where
/// it stands in front of them. Windows and walls are kept on disk in between, so memory does not
/// grow with the city.
class WindowLayout {
 private:
  struct Record {
    LitRectangle window;
    std::uint32_t owner;  // its number in WallIndex
    BuildingUse use;
  };

 public:
  /// Keeps scratch files beside `scratch`. Throws Error if they cannot be made.
  WindowLayout(const WindowOptions& options, const std::filesystem::path& scratch);

  /// The walls and windows of one object, without regard to others.
  class WindowBatch {
    friend class WindowLayout;
    std::vector<WallIndex::UprightWall> walls;
    std::vector<Record> windows;
    std::size_t dark = 0;  // number of windows that are never lit
    FacadeReport facades;
    std::string use;  // of a building, and where it comes from

   public:
    /// Passes each field to an archive (tools/archive.h).
    template <class Archive>
    void visit(Archive& archive) {
      archive(walls, windows, dark, facades, use);
    }
  };

  /// Finds the walls and windows of an object: the costly part of adding it, which many threads may
  /// do at once. Coordinates are E, N, H in metres; walls are SurfaceType::wall. Only buildings
  /// have windows; the walls of other objects may stand in front of them.
  WindowBatch make_batch(const city::CityObject& object) const { return make_batch(object, 0); }
  /// Adds an object with what make_batch found for it.
  void add(const city::CityObject& object, WindowBatch batch);
  void add(const city::CityObject& object) { add(object, make_batch(object)); }

  using Inside = std::function<bool(const glm::dvec3&)>;
  using Sink = std::function<void(const LitRectangle&)>;
  /// Passes every window that is not left out to `sink`, in the order of the buildings. If
  /// `ground` is empty, no window counts as below the ground. `inside`, if given, returns whether
  /// a place (E, N, H) is inside a building. Both are called from up to `threads` threads (0: one
  /// for each core).
  WindowReport finish(const place::HeightAt& ground, const Sink& sink, const Inside& inside = {},
                      unsigned threads = 0) &&;

 private:
  WindowBatch make_batch(const city::CityObject& object, std::uint64_t piece) const;
  void draw_lights(std::uint64_t name, const std::vector<WindowPlace>& places, BuildingUse use,
                   WindowBatch& batch) const;
  std::vector<std::uint32_t> order_by_cell(const std::vector<Record>& records) const;
  const char* fault(const Record& record, const place::HeightAt& ground, const Inside& inside);

  WindowOptions options_;
  ScratchFile pending_;
  WallIndex walls_;
  std::uint32_t owners_ = 0;  // number of objects so far
  std::string last_id_;
  std::uint64_t piece_ = 0;  // of the building of that id
  FacadeReport facades_;
  WindowReport report_;
};

/// Returns the window as a light in model space and adds its hours to `schedules`.
Light to_light(const LitRectangle& window, const Georeference& georeference,
               ScheduleTable& schedules);

}  // namespace nightcity::lights
