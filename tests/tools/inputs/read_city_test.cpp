// Files of a city, found in folders and read by the reader of their format.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "formats/error.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/inputs/city_files.h"
#include "tools/inputs/read_city.h"

namespace nightcity::inputs {
namespace {

using test::TemporaryFile;

const std::string one_building = test::city_model(test::member(test::building("A")));
const std::string empty_map = "<?xml version=\"1.0\"?>\n<osm version=\"0.6\"></osm>";

TEST(CityFiles, OtherFilesInAFolderArePassedOver) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("nightcity_folder_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "meta.xml") << "<metadata><title>t</title></metadata>";
  EXPECT_THROW(city_files(folder), Error);
  std::ofstream(folder / "city.gml") << one_building;
  std::ofstream(folder / "map.xml") << empty_map;
  std::ofstream(folder / "bake_report.json") << "{\"lamps\": 3}";
  EXPECT_EQ(city_files(folder), std::vector<std::filesystem::path>{folder / "city.gml"});
  std::filesystem::remove_all(folder);
}

TEST(ReadCity, GoesToTheReaderOfTheFormat) {
  const TemporaryFile file(one_building);
  EXPECT_EQ(read_city_head(file.path()).version, "2.0");
  std::size_t objects = 0;
  const city::ReadReport report =
      read_city(file.path(), {}, [&](city::CityObject&&) { ++objects; });
  EXPECT_EQ(objects, 1u);
  EXPECT_EQ(report.objects, 1u);
}

TEST(ReadCity, AMapIsReadForItsBuildings) {
  const TemporaryFile file(empty_map, ".gml");
  EXPECT_EQ(read_city_head(file.path()).srs_name, "EPSG:4326");
  EXPECT_EQ(read_city(file.path(), {}, [](city::CityObject&&) { FAIL(); }).objects, 0u);
}

TEST(ReadCity, AFileOfAnotherKindIsNoCity) {
  const TemporaryFile file("NCLIGHTS", ".gml");
  try {
    read_city_head(file.path());
    FAIL() << "read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("is no city model but light file"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace nightcity::inputs
