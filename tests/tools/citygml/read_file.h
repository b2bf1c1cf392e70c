// Reads CityGML whole.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/tools/city/read_city.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::test {

inline City read_file(const std::filesystem::path& file, const city::ReadOptions& options = {}) {
  City city;
  city.report = citygml::read_citygml(file, options, city.sink());
  return city;
}

/// The same with a document of this text.
inline City read(const std::string& text, const city::ReadOptions& options = {}) {
  return read_file(TemporaryFile(text).path(), options);
}

/// The same with a document of one member.
inline City read_member(const std::string& object) {
  return read(city_model(member(object)));
}

/// Returns the name of a reader, for the names of tests that run with each.
inline std::string name_reader(const testing::TestParamInfo<city::Reader>& info) {
  return info.param == city::Reader::libcitygml ? "libcitygml" : "stream";
}

}  // namespace nightcity::test
