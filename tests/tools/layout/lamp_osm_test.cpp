#include "tools/layout/lamp_osm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "support/temp_folder.h"
#include "tools/layout/layout.h"
#include "tools/layout/street_plane.h"
#include "tools/osm/read_osm.h"

namespace nightcity::layout {
namespace {

TEST(LampOsm, LaidOutLampsReadBackStandWhereTheyStoodAndShineAsTheyDid) {
  osm::OsmData osm;
  osm.highways = {test::street(5, {{-200, 10}, {150, 60}}, {{"highway", "secondary"}}),
                  test::street(6, {{-200, 10}, {-220, -180}}, {{"highway", "residential"}})};
  lights::LampSet laid;
  lay_out_lamps(osm, test::to_plane, test::plane, {}, {}, {}, laid);
  ASSERT_GT(laid.lamps.size(), 15u);

  const test::TempFolder folder;
  const auto to_lon_lat = [](const glm::dvec2& p) { return p / test::metres_per_degree; };
  EXPECT_EQ(write_lamp_osm(folder / "lamps.osm", laid.lamps, to_lon_lat), laid.lamps.size());
  osm::OsmData again = osm::read_osm(folder / "lamps.osm");
  ASSERT_EQ(again.lamps.size(), laid.lamps.size());
  again.highways = osm.highways;
  const lights::LampSet placed = lights::place_lamps(again, test::to_plane, test::plane);
  ASSERT_EQ(placed.lamps.size(), laid.lamps.size());
  for (std::size_t n = 0; n < placed.lamps.size(); ++n) {
    const lights::PlacedLamp &a = laid.lamps[n], &b = placed.lamps[n];
    EXPECT_LT(glm::distance(a.foot, b.foot), 0.01);
    EXPECT_GT(glm::dot(a.aim, b.aim), 0.9998);
    EXPECT_NEAR(glm::distance(a.outreach, b.outreach), 0, 0.05);
    EXPECT_EQ(a.mounting_height_m, b.mounting_height_m);
    EXPECT_NEAR(a.flux_lm, b.flux_lm, 0.5);
    EXPECT_EQ(a.cct_k, b.cct_k);
    EXPECT_EQ(b.provenance.flux, ValueSource::tag);
  }
  EXPECT_TRUE(placed.notes.empty());
}

TEST(LampOsm, ColoursThatAreNoTemperatureAreReadBack) {
  osm::OsmData osm;
  osm.lamps = {{1, {0, 0}, {{"highway", "street_lamp"}, {"light:colour", "#FFA500"}}},
               {2, {0.001, 0}, {{"highway", "street_lamp"}, {"lamp_type", "low_pressure_sodium"}}},
               {3, {0.002, 0}, {{"highway", "street_lamp"}, {"light:colour", "2700 K"}}}};
  const lights::LampSet before = lights::place_lamps(osm, test::to_plane, test::plane);
  ASSERT_EQ(before.lamps.size(), 3u);
  const test::TempFolder folder;
  const auto to_lon_lat = [](const glm::dvec2& p) { return p / test::metres_per_degree; };
  write_lamp_osm(folder / "lamps.osm", before.lamps, to_lon_lat);
  const lights::LampSet after =
      lights::place_lamps(osm::read_osm(folder / "lamps.osm"), test::to_plane, test::plane);
  ASSERT_EQ(after.lamps.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_LT(glm::distance(before.lamps[n].colour, after.lamps[n].colour), 0.03) << n;
}

TEST(LampOsm, EachLampNamesWhereItIsFrom) {
  osm::OsmData osm;
  osm.lamps = {{7, {0, 0}, {{"highway", "street_lamp"}}}, {8, {0.001, 0}, {}}};
  osm.lamps[1].is_inventory = true;
  const lights::LampSet lamps = lights::place_lamps(osm, test::to_plane, test::plane);
  ASSERT_EQ(lamps.lamps.size(), 2u);
  const test::TempFolder folder;
  write_lamp_osm(folder / "lamps.osm", lamps.lamps,
                 [](const glm::dvec2& p) { return p / test::metres_per_degree; });
  const std::string text = test::read_text(folder / "lamps.osm");
  EXPECT_NE(text.find("v=\"OpenStreetMap node 7\""), std::string::npos) << text;
  EXPECT_NE(text.find("v=\"inventory of lamps, row 8\""), std::string::npos)
      << "a town's lamp is no node of OpenStreetMap\n"
      << text;
}

}  // namespace
}  // namespace nightcity::layout
