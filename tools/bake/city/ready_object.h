// One object of a city, with all the work done that needs no other object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "tools/bake/city/city_consumer.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/city/ground_heights.h"
#include "tools/mesh/mesh_report.h"

namespace nightcity::bake {

class PictureBudget;

/// From the city's first point. A stray point beyond this would cost every other vertex its
/// precision.
constexpr double max_distance_m = 100'000;

/// Why an object has no part in the city, whatever else is there.
enum class Unusable : std::uint8_t {
  no,
  without_geometry,
  far_away,
  without_area,
  beyond_limits,
  without_ground,
  replaced_by_map
};

struct ReadyObject {
  std::shared_ptr<PreparedObject> prepared;
  std::uint64_t identity = 0;  // of its id and first vertex; 0 = it has no id
  std::uint64_t contents = 0;  // of all of its outlines
  Unusable unusable = Unusable::no;
  mesh::MeshReport report;
  bool beyond_heights = false;  // it stands on a height of the ground near it
  std::string elsewhere;        // a CRS that it names beside the file's
  /// The object as it was read, where it names a CRS that is not known yet; the other members mean
  /// nothing then.
  std::optional<city::CityObject> unknown;
};

/// These settings say how the objects of a city are made ready.
struct ReadySettings {
  const CityFrames& frames;
  /// Heights of the ground, for objects of a model without heights of its own, as a map's buildings
  /// are; null: objects have heights. Such an object stands on the lowest height below its
  /// outlines, as OpenStreetMap counts the height of a building, or on one near it. Without any it
  /// is left out.
  const GroundHeights* heights = nullptr;
  city::PolygonLimits polygon{};
  double simplify_m = 0;   // of buildings: CityInputs
  double max_error_m = 0;  // of relief: GroundOptions
  double texels_per_m = 0;
  const PictureBudget* picture_budget = nullptr;  // null: objects have all their pictures
  bool drops_roads = false;                       // those of the map stand for them
};
ReadySettings to_ready_settings(const CityInputs& inputs, const CityFrames& frames,
                                const GroundHeights* heights);

/// Places an object of the input file of that number in the city's frame, repairs its shells and
/// triangulates it. May be called from many threads.
ReadyObject make_ready(city::CityObject&& object, std::size_t file, const ReadySettings& settings);

/// Calls `visit(srs_name, coordinates)` for each part of the object that names a CRS of its own.
void for_each_named(const city::CityObject& object,
                    const std::function<void(const std::string&, const city::Ring&)>& visit);

/// Returns whether `object` is of a kind that lies on the ground and every vertex of it has height
/// 0 exactly, as in the file: it was published without heights (PLATEAU's roads in LoD1).
bool lacks_heights(const city::CityObject& object);

}  // namespace nightcity::bake
