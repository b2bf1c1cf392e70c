// Reads CityGML whole.
#pragma once

#include <filesystem>

#include "tests/tools/city/read_city.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::test {

inline City read_file(const std::filesystem::path& file, const city::ReadOptions& options = {}) {
  City city;
  city.report = citygml::read_citygml(file, options, city.sink());
  return city;
}

}  // namespace nightcity::test
