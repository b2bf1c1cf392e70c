// Real files land where their cities are.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/data.h"
#include "tools/citygml/citygml_head.h"
#include "tools/georeference/frame.h"

namespace nightcity::georeference {
namespace {

struct Place {
  const char* file;
  double west, south, east, north;  // degrees
  const char* crs;                  // name of the frame, or how it begins
};

// The boxes of the cities are from maps, not from any reader of these files.
const std::vector<Place> places{
    {"berlin/3910_5819.gml", 13.38, 52.50, 13.42, 52.52, "EPSG:25833"},
    {"nrw/LoD2_32_328_5728_1_NW.gml", 6.4, 51.6, 6.6, 51.75, "EPSG:25832"},
    {"osaka/52350302_bldg_6697_op.gml", 135.3, 34.5, 135.7, 34.8, "+proj=tmerc"},
    {"helsinki/2549_6674.gml", 24.9, 60.15, 25.0, 60.2, "EPSG:3879"},
    {"london/London_LOD2.gml", -0.04, 51.53, 0.0, 51.56, "EPSG:27700"},
    {"munich/TUM_Munich.gml", 11.55, 48.14, 11.58, 48.16, "EPSG:31468"},
    {"vienna/Karl-Marx-Hof/city.gml", 16.35, 48.24, 16.38, 48.26, "EPSG:31256"},  // Heiligenstadt
    {"misc/zurich-lod2-citygml1.xml", 8.5, 47.3, 8.6, 47.4, "EPSG:21781"},
    {"misc/poland-lod1.gml", 19.06, 52.65, 19.07, 52.66, "EPSG:2180"},
    {"misc/building-test.gml", -74.0, 40.74, -73.98, 40.76, "+proj=lcc"},
    {"karlsruhe/technologiepark_WGS84.gml", 8.43, 49.01, 8.45, 49.03, "+proj=tmerc"},
    {"ogc3/melbourne_roads_4way_v3.gml", 144.9, -37.9, 145.0, -37.7, "EPSG:32755"},
    {"ogc3/Opera-Lyon_CityGML3.0_LOD2.gml", 4.83, 45.76, 4.84, 45.78, "EPSG:3946"},
};

class RealPlaces : public testing::TestWithParam<Place> {};

TEST_P(RealPlaces, FileLandsInItsCityAndComesBack) {
  REAL_DATA(file, GetParam().file);
  const city::CityHead head = citygml::read_citygml_head(file);
  ASSERT_FALSE(head.sample.empty());
  const CityFrame frame = CityFrame::from_srs_name(head.srs_name, head.sample, {});
  EXPECT_EQ(frame.crs().rfind(GetParam().crs, 0), 0u) << frame.crs();
  std::vector<glm::dvec3> points = head.sample;
  frame.to_projected(points);
  for (std::size_t i = 0; i < points.size(); i += 97) {
    const glm::dvec2 lon_lat = frame.to_lon_lat({points[i].x, points[i].y});
    EXPECT_TRUE(lon_lat.x > GetParam().west && lon_lat.x < GetParam().east &&
                lon_lat.y > GetParam().south && lon_lat.y < GetParam().north)
        << lon_lat.x << ", " << lon_lat.y << "; " << frame.description();
    const glm::dvec2 back = frame.from_lon_lat(lon_lat);
    constexpr double tolerance_m =
        2e-3;  // a datum's small-angle rotation, undone, leaves a millimetre
    EXPECT_NEAR(back.x, points[i].x, tolerance_m);
    EXPECT_NEAR(back.y, points[i].y, tolerance_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Frame, RealPlaces, testing::ValuesIn(places));

}  // namespace
}  // namespace nightcity::georeference
