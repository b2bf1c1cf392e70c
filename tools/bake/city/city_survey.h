// The survey of a city: all that has to be known of its inputs as a whole before the first object
// is read. Parts of a bake share it, so that each does not look through all inputs again.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/osm_data.h"

namespace nightcity::bake {

struct CityInputs;

/// The plan's extent of all geometry, as written: least and greatest coordinates.
struct PlanExtent {
  glm::dvec2 low{0}, high{0};
};

struct CitySurvey {
  std::vector<city::CityHead> heads;                // of the city's files, in their order
  std::vector<std::uint64_t> sizes;                 // bytes
  std::vector<std::optional<city::FileCuts>> cuts;  // of those that may be cut into pieces
  std::optional<PlanExtent> extent;                 // where the inputs have bounds
  // Buildings of the map, which say what buildings are used for.
  std::vector<osm::OsmWay> map_buildings;
  std::vector<osm::MapArea> map_multipolygons;

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(heads, sizes, cuts, extent, map_buildings, map_multipolygons);
  }
};

/// Looks through the inputs. Files smaller than a 256th of all are not cut. Throws Error as the
/// readers do.
CitySurvey survey_city(const CityInputs& inputs);

/// Reads every file for the extent of its geometry.
PlanExtent find_extent(const CityInputs& inputs);

}  // namespace nightcity::bake
