// The buildings of one map, with what belongs to them in the other maps of the city.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/osm/map_areas.h"

namespace nightcity::map_buildings {

/// The maps of one city, and their buildings once these are asked for. They are kept as long as
/// this lives, as a city asks for each map in turn, and each needs all others. The files must not
/// change meanwhile.
class CityMaps {
 public:
  using Areas = std::vector<std::shared_ptr<const osm::MapAreas>>;  // one for each file

  explicit CityMaps(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  const std::vector<std::filesystem::path>& files() const { return files_; }
  /// May be called on several threads. Throws Error: a map is missing or broken.
  Areas read(int max_way_nodes);
  /// Returns those of the only map, which are not kept any longer, as nothing else needs them.
  osm::MapAreas take_only(int max_way_nodes);

 private:
  std::vector<std::filesystem::path> files_;
  std::mutex mutex_;
  std::optional<int> max_way_nodes_;  // that areas_ was read with
  std::vector<std::shared_ptr<osm::MapAreas>> areas_;
};

struct FileBuildings {
  /// The file's own, and behind these the ones that only other maps have: parts may lie in them.
  std::vector<osm::MapArea> buildings;
  std::size_t own = 0;
  /// Parts of buildings, of all maps, each once.
  std::vector<osm::MapArea> parts;
  std::vector<bool> is_own_part;  // whether the file has it
  osm::MapAreas counts;           // of the file, without areas
  /// Chimneys, tanks and the like of the file, which are no buildings and stand as they do.
  std::vector<osm::MapArea> tall_things;
  std::map<std::string, std::size_t> left_out;  // of them and of points, by reason
};

/// Reads the buildings of `file`. Where it is one of several in `options.maps`, a map that was cut
/// into tiles is one again: a building at a seam has the parts that only another tile has, and an
/// outline that is a multipolygon's there is none of its own. Throws Error: missing or broken.
FileBuildings read_file_buildings(const std::filesystem::path& file,
                                  const city::ReadOptions& options);

}  // namespace nightcity::map_buildings
