// A small city of two files that hold the same, and a consumer that keeps its objects.
#pragma once

#include <memory>
#include <vector>

#include "support/temp_folder.h"
#include "tools/bake/city/city.h"
#include "tools/bake/city/city_consumer.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::bake {

inline CityInputs two_files(const test::TempFolder& folder) {
  test::write_text(folder / "a.gml", test::sample_gml());
  test::write_text(folder / "b.gml", test::sample_gml());
  CityInputs inputs;
  inputs.files = {folder / "a.gml", folder / "b.gml"};
  return inputs;
}

inline CityInputs two_files_and_map(const test::TempFolder& folder) {
  CityInputs inputs = two_files(folder);
  test::write_text(folder / "map.osm", test::sample_osm());
  inputs.maps = {folder / "map.osm"};
  return inputs;
}

/// Keeps what has been read.
class Collector final : public CityConsumer {
 public:
  Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override {
    return [this, prepared](bool) { objects.push_back(prepared); };
  }
  std::vector<std::shared_ptr<const PreparedObject>> objects;
};

}  // namespace nightcity::bake
