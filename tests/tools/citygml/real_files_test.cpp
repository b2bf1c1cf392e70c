// Every CityGML file of the data folder is read without an abort, and every polygon is in the model
// or in the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/data.h"
#include "tests/tools/citygml/read_file.h"
#include "tools/citygml/read_citygml.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {
namespace {

std::vector<std::filesystem::path> city_files(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension();
    if (entry.is_regular_file() &&
        (extension == ".gml" || extension == ".xml" || extension == ".citygml"))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Counts the start tags of polygons in the text without any parser: the true number.
std::size_t polygons_in(const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    if (text.compare(at, 4, "<!--") == 0) at = text.find("-->", at);
    std::size_t end = at + 1;
    while (end < text.size() && !ends_name(text[end])) ++end;
    const std::string_view name = local_name(std::string_view(text).substr(at + 1, end - at - 1));
    count += text[at + 1] != '/' && (name == "Polygon" || name == "PolygonPatch" ||
                                     name == "Triangle" || name == "Rectangle");
  }
  return count;
}

struct Tally {
  std::size_t files = 0, refused = 0, in_files = 0, delivered = 0, reported = 0;
};

// `largest`: longer files are left out, in bytes.
Tally read_all(const std::filesystem::path& root, city::Reader reader, std::uintmax_t largest) {
  Tally tally;
  for (const std::filesystem::path& file : city_files(root)) {
    if (std::filesystem::file_size(file) > largest) continue;
    ++tally.files;
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    const std::size_t truth = polygons_in(text.str());
    city::ReadOptions options;
    options.reader = reader;
    try {
      std::size_t delivered = 0;
      const city::ReadReport report = read_citygml(
          file, options, [&](city::CityObject&& o) { delivered += o.polygons.size(); });
      std::size_t reported = 0;
      for (const auto& [what, count] : report.skipped)
        if (what.starts_with("polygon: ")) reported += count;
      EXPECT_EQ(delivered, report.polygons) << file;
      EXPECT_EQ(delivered + reported, truth) << file;
      tally.in_files += truth;
      tally.delivered += delivered;
      tally.reported += reported;
    } catch (const Error& e) {
      ++tally.refused;
      EXPECT_NE(std::string(e.what()).find("is not CityGML"), std::string::npos) << e.what();
    }
  }
  return tally;
}

class RealFiles : public testing::TestWithParam<city::Reader> {};

TEST_P(RealFiles, EveryPolygonIsDeliveredOrReported) {
  REAL_DATA(root, ".");
  // libcitygml is slow: the small files are enough to show every producer.
  const Tally tally =
      read_all(root, GetParam(), GetParam() == city::Reader::stream ? UINTMAX_MAX : 500'000);
  EXPECT_GT(tally.files, 100u);
  EXPECT_LE(tally.refused, 1u);  // the one IndoorGML file
  std::printf("%zu files, %zu refused; %zu polygons: %zu delivered, %zu reported\n", tally.files,
              tally.refused, tally.in_files, tally.delivered, tally.reported);
}

INSTANTIATE_TEST_SUITE_P(CityGml, RealFiles,
                         testing::Values(city::Reader::stream, city::Reader::libcitygml),
                         test::name_reader);

// The content of a file, counted by hand.
TEST(RealFile, MunichCrossingOfCityGml3HasItsTrafficAreas) {
  REAL_DATA(file, "munich/TUM_citygml_V3_update.gml");
  std::size_t areas = 0, roads = 0;
  read_citygml(file, {}, [&](city::CityObject&& o) {
    roads += o.type == city::ObjectType::road;
    areas += static_cast<std::size_t>(std::count_if(
        o.polygons.begin(), o.polygons.end(),
        [](const city::Polygon& p) { return p.surface == city::SurfaceType::traffic_area; }));
  });
  EXPECT_EQ(roads, 4u);
  EXPECT_EQ(areas, 141u);
}

TEST(RealFile, SentinelStoreysAreAbsent) {
  REAL_DATA(file, "osaka/bldg/51357353_bldg_6697_op.gml");
  read_citygml(file, {}, [&](city::CityObject&& o) {
    EXPECT_LT(o.storeys_above_ground.value_or(0), 500);
    EXPECT_GT(o.measured_height_m.value_or(1), 0);
  });
}

}  // namespace
}  // namespace nightcity::citygml
