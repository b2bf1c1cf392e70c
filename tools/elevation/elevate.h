// Finds the height of the ground under each lamp of a map: from the model, else a raster, else a
// service.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/elevation/dem_raster.h"
#include "tools/elevation/elevation_service.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/terrain/terrain.h"

namespace nightcity::elevation {

/// The sources of heights, in the order in which they are asked; null = absent.
struct ElevationSources {
  const terrain::Terrain* terrain = nullptr;
  place::LonLatToFrame to_frame;  // to the terrain's E, N
  const DemRaster* dem = nullptr;
  const ElevationServiceOptions* service = nullptr;
};

/// A raster and a service have other vertical datums than the model. The median of the differences
/// where both heights are known brings theirs to the model's: one number, so that no slope is
/// invented.
struct HeightOffset {
  double metres = 0;     // added to the raster's or service's heights
  double deviation = 0;  // median absolute deviation of the differences: how well one number fits
  std::size_t samples = 0;  // places known in both; with fewer than 3 nothing is added
};

struct Elevations {
  std::map<std::int64_t, double> heights;  // by node, m; of the model where there is one
  /// "terrain", "road", "building ground", "roof", "raster", "service", "nothing", and how often.
  std::map<std::string, std::size_t> sources;
  std::size_t outside_model = 0, inside_buildings = 0;
  std::size_t duplicates = 0;  // lamps within 0.3 m of another
  HeightOffset raster_offset, service_offset;
  ElevationAnswers service;  // its heights are in `heights`
};

/// Returns the heights of all lamps that a source knows. Throws Error as ask_elevations does.
Elevations elevate_lamps(const std::vector<osm::OsmLampNode>& lamps,
                         const ElevationSources& sources);

}  // namespace nightcity::elevation
