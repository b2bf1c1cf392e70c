// Areas of a map across the antimeridian, as at Taveuni in Fiji.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/temp_folder.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/osm_collector.h"
#include "tools/place/longitude.h"
#include "tools/ring_area.h"

namespace nightcity::osm {
namespace {

constexpr double latitude = -16.8;

std::string to_node(int id, double longitude, double x, double y) {
  return fmt::format("<node id='{}' version='1' lat='{:.7f}' lon='{:.7f}'/>\n", id, latitude + y,
                     place::count_on(longitude + x, 0));
}

std::string to_way(int id, int first, int last, const char* tags) {
  std::string text = fmt::format("<way id='{}' version='1'>", id);
  for (int n = first; n <= last; ++n) text += fmt::format("<nd ref='{}'/>", n);
  return text + fmt::format("<nd ref='{}'/>{}</way>\n", first, tags);
}

// A star with 20 points as a wood, whose sides would cross each other round the globe; a lake in
// two ways with an island; and a house in the east of all of them.
std::string make_map(double longitude) {
  std::string nodes, ways;
  for (int k = 0; k < 20; ++k) {
    const double r = k % 2 ? 0.002 : 0.005, a = std::numbers::pi * (k + 0.3) / 10;
    nodes += to_node(1 + k, longitude, r * std::cos(a), r * std::sin(a));
  }
  ways += to_way(1, 1, 20, "<tag k='natural' v='wood'/>");
  const glm::dvec2 lake[] = {{-0.003, 0.02}, {0.004, 0.02}, {0.003, 0.026}, {-0.004, 0.027}};
  for (int k = 0; k < 4; ++k) nodes += to_node(31 + k, longitude, lake[k].x, lake[k].y);
  ways +=
      "<way id='2' version='1'><nd ref='31'/><nd ref='32'/><nd ref='33'/></way>\n"
      "<way id='3' version='1'><nd ref='33'/><nd ref='34'/><nd ref='31'/></way>\n";
  const glm::dvec2 island[] = {{-0.001, 0.022}, {0.001, 0.022}, {0, 0.024}};
  for (int k = 0; k < 3; ++k) nodes += to_node(41 + k, longitude, island[k].x, island[k].y);
  ways += to_way(4, 41, 43, "");
  const glm::dvec2 house[] = {{0.01, 0}, {0.0101, 0}, {0.0101, 0.0001}, {0.01, 0.0001}};
  for (int k = 0; k < 4; ++k) nodes += to_node(51 + k, longitude, house[k].x, house[k].y);
  ways += to_way(5, 51, 54, "<tag k='natural' v='scrub'/>");
  return "<osm version='0.6'>" + nodes + ways +
         "<relation id='9' version='1'><member type='way' ref='2' role='outer'/>"
         "<member type='way' ref='3' role='outer'/><member type='way' ref='4' role='inner'/>"
         "<tag k='type' v='multipolygon'/><tag k='natural' v='water'/></relation></osm>";
}

MapAreas read(const test::TempFolder& folder, double longitude) {
  std::ofstream(folder / "map.osm") << make_map(longitude);
  return read_map_areas(folder / "map.osm", {{"natural"}}, 1000);
}

TEST(Antimeridian, AreasAcrossItAreThoseOfTheSameMapElsewhere) {
  const test::TempFolder folder;
  const MapAreas expected = read(folder, 174);
  ASSERT_EQ(expected.areas.size(), 3u);
  for (const double longitude : {180.0, 179.999, -179.9995, 0.0}) {
    const MapAreas found = read(folder, longitude);
    EXPECT_EQ(found.broken, 0u) << longitude;
    ASSERT_EQ(found.areas.size(), 3u) << longitude;
    for (std::size_t n = 0; n < 3; ++n) {
      const MapArea &a = expected.areas[n], &b = found.areas[n];
      EXPECT_EQ(a.id, b.id);
      ASSERT_EQ(b.rings.size(), 1u);
      ASSERT_EQ(a.rings[0].outer.size(), b.rings[0].outer.size());
      ASSERT_EQ(a.rings[0].holes.size(), b.rings[0].holes.size());
      // Its longitudes are counted on, so that its shape is that on the ground.
      EXPECT_NEAR(signed_area(a.rings[0].outer), signed_area(b.rings[0].outer), 1e-9);
      if (!a.rings[0].holes.empty()) {
        EXPECT_NEAR(signed_area(a.rings[0].holes[0]), signed_area(b.rings[0].holes[0]), 1e-9);
      }
    }
  }
}

TEST(Antimeridian, PlacesElsewhereAreThoseOfTheFile) {
  const test::TempFolder folder;
  for (const double longitude : {139.7, -150.3, 12.5, -90.001}) {
    const MapAreas found = read(folder, longitude);
    ASSERT_EQ(found.areas.size(), 3u);
    bool is_there = false;
    for (const MapArea& area : found.areas)
      for (const glm::dvec2& p : area.rings[0].outer)
        is_there |= p == glm::dvec2(std::stod(fmt::format("{:.7f}", longitude + 0.01)), latitude);
    EXPECT_TRUE(is_there) << longitude;
  }
}

TEST(Antimeridian, BoundsOnBothSidesOfItAreOneRectangle) {
  const LonLatBox west{{179.9, -17}, {180, -16.5}}, east{{-180, -17.2}, {-179.8, -16.6}},
      both{{179.9, -17.2}, {-179.8, -16.5}};
  for (const std::vector<LonLatBox>& boxes :
       {std::vector{west, east}, std::vector{east, west}, std::vector{both}}) {
    OsmCollector collector;
    collector.begin_file();
    for (const LonLatBox& box : boxes) collector.add_bounds(box);
    const auto found = std::move(collector).finish().bounds;
    ASSERT_TRUE(found);
    EXPECT_NEAR(place::count_on(found->low.x, 180), 179.9, 1e-9);
    EXPECT_NEAR(place::count_on(found->high.x, 180), 180.2, 1e-9);
    EXPECT_NEAR(found->high.x - found->low.x, 0.3, 1e-9);
    EXPECT_EQ(found->low.y, -17.2);
    EXPECT_EQ(found->high.y, -16.5);
  }
  OsmCollector swapped;
  swapped.begin_file();
  swapped.add_bounds({{14, 52}, {13, 53}});
  EXPECT_FALSE(std::move(swapped).finish().bounds);
}

TEST(Antimeridian, ALampThatIsAnAreaAcrossItStandsInItsMiddle) {
  OsmCollector collector;
  collector.begin_file();
  const double x[] = {179.9999, -179.9999, -179.9999, 179.9999}, y[] = {0, 0, 0.0001, 0.0001};
  std::vector<OsmNodeRef> nodes;
  for (int k = 0; k < 4; ++k) {
    collector.add_node(k + 1, {1}, {x[k], y[k]}, {});
    nodes.push_back({k + 1});
  }
  nodes.push_back({1});
  collector.add_way(1, {1}, nodes, {{"man_made", "tower"}, {"tower:type", "lighting"}});
  const OsmData map = std::move(collector).finish();
  ASSERT_EQ(map.lamps.size(), 1u);
  EXPECT_NEAR(std::abs(map.lamps[0].lon_lat.x), 180, 1e-7);
  EXPECT_NEAR(map.lamps[0].lon_lat.y, 0.00005, 1e-9);
}

}  // namespace
}  // namespace nightcity::osm
