// Both readers make an Error or a city of every document of the corpus, and never crash.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formats/error.h"
#include "tests/tools/citygml/read_file.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

class Corpus : public testing::TestWithParam<city::Reader> {};

TEST_P(Corpus, EveryDocumentIsReadOrRefused) {
  std::size_t files = 0;
  const auto folder = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/citygml/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++files;
    city::ReadOptions options;
    options.reader = GetParam();
    try {
      read_citygml(entry.path(), options, [](city::CityObject&& object) {
        for (const city::Polygon& polygon : object.polygons)
          for (const glm::dvec3& p : polygon.exterior) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
      });
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(entry.path().filename().string()), std::string::npos)
          << e.what();
    }
  }
  EXPECT_GE(files, 8u);
}

INSTANTIATE_TEST_SUITE_P(CityGml, Corpus,
                         testing::Values(city::Reader::stream, city::Reader::libcitygml),
                         test::name_reader);

}  // namespace
}  // namespace nightcity::citygml
