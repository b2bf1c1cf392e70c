// The ground under each lamp of a map: from the model, else a raster, else a service.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/elevation/dem_raster.h"
#include "tools/elevation/elevation_service.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

/// What may be asked, in this order; null = not there.
struct ElevationSources {
  const Terrain* terrain = nullptr;
  std::function<glm::dvec2(const glm::dvec2&)>
      to_frame;  // longitude, latitude to the terrain's E, N
  const DemRaster* dem = nullptr;
  const ElevationServiceOptions* service = nullptr;
};

/// A raster and a service count from other zeros than the model does. The median of the differences where
/// both are known brings them to the model's: one number, so that no slope is invented.
struct HeightOffset {
  double metres = 0;     // added to the raster's or service's heights
  double deviation = 0;  // median absolute deviation of the differences: how well one number fits
  std::size_t samples = 0;  // places known in both; below 3 nothing is added
};

struct Elevations {
  std::map<std::int64_t, double> heights;  // by node, m; of the model where there is one
  std::map<std::string, std::size_t>
      sources;  // "terrain", "road", "building ground", "roof", "raster", "service", "nothing"
  std::size_t outside_model = 0, inside_buildings = 0,
              duplicates = 0;  // duplicates: within 0.3 m of another
  HeightOffset raster_offset, service_offset;
  ElevationAnswers service;  // its heights are in `heights`
};

/// Throws Error as ask_elevations does.
Elevations elevate_lamps(const std::vector<OsmLampNode>& lamps, const ElevationSources& sources);

}  // namespace nightcity
