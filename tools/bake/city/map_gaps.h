// The buildings of a map that the city model lacks.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "tools/bake/city/city_consumer.h"
#include "tools/city/city_reader.h"
#include "tools/georeference/frame.h"
#include "tools/terrain/terrain.h"

namespace nightcity::bake {

struct GapReport {
  std::size_t buildings = 0;                    // of the map that stand in the city
  std::map<std::string, std::size_t> left_out;  // by reason
  std::map<std::string, std::size_t> assumed;   // heights that no tag says
};

/// Passes the map's buildings to `consumers`, in file order, as far as they stand on the terrain
/// and the model has nothing there: a building of which a tenth lies on the model's own is the
/// model's. Each stands on the lowest ground below its outline. What the consumers' turns add to
/// the terrain is added last, by `ground`. Throws Error as the map's reader does.
void fill_gaps(const std::filesystem::path& map, const city::ReadOptions& options,
               const georeference::CityFrame& frame, const terrain::Terrain& terrain,
               std::span<CityConsumer* const> consumers, CityConsumer& ground, GapReport& report);

}  // namespace nightcity::bake
