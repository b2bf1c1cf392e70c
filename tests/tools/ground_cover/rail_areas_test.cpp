#include "tools/ground_cover/rail_areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/tools/ground_cover/plan_areas.h"
#include "tools/ground_cover/street_areas.h"
#include "tools/ground_cover/tracks.h"

namespace nightcity::ground_cover {
namespace {

osm::OsmWay track(osm::OsmTags tags) {
  tags.emplace("railway", "rail");
  return way({{-200, 0}, {200, 0}}, std::move(tags));
}

Cover cover_rails(const std::vector<osm::OsmWay>& railways,
                  const std::vector<osm::OsmWay>& streets = {}, bool markings = false) {
  Cover cover;
  add_streets(streets, true, as_metres, bounds, cover);
  if (markings) add_markings({streets, {}, {}}, as_metres, bounds, cover);
  add_rails(railways, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

constexpr double rails_m2 = 100 * 2 * rail_head_m;

TEST(RailAreas, ATrackOfItsOwnHasTwoRailsOnABedOfBallast) {
  const Cover cover = cover_rails({track({{"gauge", "1435"}})});
  const auto areas = areas_of(cover, middle);
  // Outlines lie on a grid of a millimetre.
  EXPECT_NEAR(areas.at("rail"), rails_m2, 100 * 2e-3);
  EXPECT_NEAR(areas.at("ballast"), 100 * 4.90 - rails_m2, 100 * 4e-3);
  EXPECT_FALSE(areas.contains("sunken"));
  EXPECT_NEAR(cover.tracks_m.at("rail on ballast"), 400, 1e-9);
  EXPECT_EQ(cover.assumed.at("ballast under a track"), 1u);
}

TEST(RailAreas, InnerFacesLieTheGaugeApartAlsoInABend) {
  // A quarter circle of 100 m, a point every degree.
  std::vector<glm::dvec2> line;
  for (int degree = 0; degree <= 90; ++degree)
    line.push_back(100.0 *
                   glm::dvec2(std::cos(degree * M_PI / 180), std::sin(degree * M_PI / 180)));
  const Cover cover = cover_rails({way(line, {{"railway", "tram"}, {"gauge", "1000"}})});
  const CoverPart part = cover.find_part(bounds, {0, 0});
  ASSERT_EQ(part.markings.size(), 2u * 90);
  for (const mesh::PlaneArea& area : part.markings)
    for (const glm::dvec2& p : area.rings.at(0)) {
      // The corners of the rails lie on four circles: mitres are longer than a radius by the share
      // of a degree's chord, and corners lie on a grid of a millimetre.
      const double off_m = std::abs(std::hypot(p.x, p.y) - 100);
      EXPECT_TRUE(std::abs(off_m - 0.5) < 2e-3 || std::abs(off_m - 0.5 - rail_head_m) < 2e-3)
          << off_m;
    }
}

TEST(RailAreas, ATramInAStreetHasRailsAloneFlushWithIt) {
  const Cover cover = cover_rails({track({{"railway", "tram"}})},
                                  {way({{-200, 1}, {200, 1}}, {{"highway", "residential"}})});
  const auto areas = areas_of(cover, middle);
  EXPECT_FALSE(areas.contains("ballast"));
  EXPECT_NEAR(areas.at("rail"), rails_m2, 0.2);
  EXPECT_NEAR(areas.at("asphalt"), 100 * 5.5 - rails_m2, 0.5);
  EXPECT_NEAR(cover.tracks_m.at("tram in a street"), 400, 1e-9);
  EXPECT_EQ(cover.areas().size(), 4u) << "a carriageway, its ends and its pavements";
}

TEST(RailAreas, WhereARoadCrossesItLiesOverTheBedAndTheRailsGoOn) {
  const Cover cover = cover_rails(
      {track({})}, {way({{0, -200}, {0, 200}}, {{"highway", "primary"}, {"sidewalk", "no"}})});
  const auto areas = areas_of(cover, middle);
  EXPECT_NEAR(areas.at("rail"), rails_m2, 0.2);
  EXPECT_NEAR(areas.at("asphalt"), 80 * 6.5 - 6.5 * 2 * rail_head_m, 0.2);
  EXPECT_NEAR(areas.at("ballast"), (100 - 6.5) * (4.90 - 2 * rail_head_m), 0.5);
  EXPECT_NEAR(cover.tracks_m.at("rail on ballast"), 400, 1e-9)
      << "a crossing is no street it runs in";
}

TEST(RailAreas, ABedLiesOverThePavementsThatItRunsAlongAndUnderThoseThatItCrosses) {
  const osm::OsmTags tram{{"railway", "tram"}, {"surface", "grass"}};
  // Between two carriageways of 3.5 m whose pavements of 2.5 m meet in the middle.
  const osm::OsmTags oneway{{"highway", "residential"}, {"oneway", "yes"}};
  const Cover along = cover_rails({track(tram)}, {way({{-200, 4.25}, {200, 4.25}}, oneway),
                                                  way({{200, -4.25}, {-200, -4.25}}, oneway)});
  EXPECT_NEAR(areas_of(along, middle).at("grass"), 100 * 2.65 - rails_m2, 0.5);
  EXPECT_NEAR(along.tracks_m.at("tram on grass"), 400, 1e-9);
  const Cover unsaid =
      cover_rails({track({{"railway", "tram"}})}, {way({{-200, 4.25}, {200, 4.25}}, oneway)});
  EXPECT_FALSE(areas_of(unsaid, middle).contains("ballast")) << "it runs in the street";
  const Cover railway = cover_rails({track({})}, {way({{-200, 4.25}, {200, 4.25}}, oneway)});
  EXPECT_TRUE(areas_of(railway, middle).contains("ballast"));
  const Cover across =
      cover_rails({track(tram)}, {way({{0, -200}, {0, 200}}, {{"highway", "residential"}})});
  EXPECT_NEAR(areas_of(across, middle).at("grass"),
              (100 - 5.5 - 2 * 2.5) * (3.40 - 2 * rail_head_m), 0.5);
  EXPECT_NEAR(areas_of(across, middle).at("rail"), rails_m2, 0.2);
}

TEST(RailAreas, PathsAndPlatformsLieOverTheBed) {
  const Cover cover =
      cover_rails({track({})}, {way({{0, -200}, {0, 200}}, {{"highway", "footway"}})});
  EXPECT_NEAR(areas_of(cover, middle).at("ballast"), (100 - 2.5) * (4.90 - 2 * rail_head_m), 0.5);
  EXPECT_GT(platform_rank, bed_rank);
}

TEST(RailAreas, AGrassTrackLiesInGrass) {
  const auto areas =
      areas_of(cover_rails({track({{"railway", "tram"}, {"surface", "grass"}})}), middle);
  EXPECT_NEAR(areas.at("grass"), 100 * 3.40 - rails_m2, 0.4);
  EXPECT_FALSE(areas.contains("ballast"));
}

TEST(RailAreas, TwoTracksOfAWayLieOnOneBed) {
  const auto areas = areas_of(cover_rails({track({{"tracks", "2"}})}), middle);
  EXPECT_NEAR(areas.at("rail"), 2 * rails_m2, 0.4);
  EXPECT_NEAR(areas.at("ballast"), 100 * (4.90 + 4.00) - 2 * rails_m2, 0.6);
}

TEST(RailAreas, PaintEndsAtRails) {
  const Cover cover =
      cover_rails({track({{"railway", "tram"}})},
                  {way({{-200, 0}, {200, 0}}, {{"highway", "tertiary"}, {"lane_markings", "no"}}),
                   way({{0, -10}, {0, 10}},
                       {{"highway", "footway"}, {"footway", "crossing"}, {"crossing", "zebra"}})},
                  true);
  const auto areas = areas_of(cover, middle);
  EXPECT_NEAR(areas.at("rail"), rails_m2, 0.2);
  EXPECT_GT(areas.at("paint"), 10);
  EXPECT_LE(areas.at("paint"), 6 * 4 / 2 + 2 - 4 * rail_head_m);
}

TEST(RailAreas, ABridgeHasTracksWhereItCarriesAStreetAlone) {
  const std::vector<osm::OsmWay> along{way({{-200, 0}, {200, 0}}, {{"highway", "primary"}})},
      across{way({{0, -200}, {0, 200}}, {{"highway", "primary"}})};
  const osm::OsmTags bridge{{"railway", "tram"}, {"bridge", "yes"}};
  EXPECT_NEAR(cover_rails({track(bridge)}, along).tracks_m.at("tram in a street"), 400, 1e-9);
  const Cover over = cover_rails({track(bridge)}, across);
  EXPECT_TRUE(over.tracks_m.empty());
  EXPECT_NEAR(over.left_out_m.at("tracks on a bridge that carries no street"), 400, 1e-9);
  EXPECT_FALSE(areas_of(over, middle).contains("rail"));
}

TEST(RailAreas, AllOfAWayWithinTheGroundIsBuiltOrLeftOut) {
  const std::vector<osm::OsmWay> railways{
      way({{-900, 3}, {900, 7}}, {{"railway", "rail"}}),
      way({{-400, -400}, {100, 0}, {100, 80}, {800, 80}}, {{"railway", "tram"}}),
      way({{0, -900}, {0, 900}}, {{"railway", "subway"}, {"tunnel", "yes"}}),
      way({{-300, 200}, {300, 200}}, {{"railway", "razed"}}),
      way({{-300, 100}, {300, 100}}, {{"railway", "light_rail"}, {"bridge", "viaduct"}}),
      way({{-300, 90}, {300, 90}}, {{"railway", "platform"}})};
  const Cover cover =
      cover_rails(railways, {way({{-100, 80}, {300, 80}}, {{"highway", "primary"}})});
  double counted_m = 0;
  for (const auto& [name, m] : cover.tracks_m) counted_m += m;
  for (const auto& [name, m] : cover.left_out_m) counted_m += m;
  const double mapped_m =
      std::hypot(1000, 1000 * 4 / 1800.0) + std::hypot(500, 400) + 80 + 400 + 1000 + 600 + 600;
  EXPECT_NEAR(counted_m, mapped_m, 1e-6);
}

TEST(RailAreas, HostileWaysEndWithACount) {
  const double nan = std::nan("");
  std::vector<glm::dvec2> zigzag;
  for (int i = 0; i < 20'000; ++i) zigzag.emplace_back(i % 2 ? 499 : -499, -499 + i * 0.04);
  const Cover cover =
      cover_rails({way({{nan, nan}, {nan, nan}}, {{"railway", "rail"}}),
                   way({{0, 0}, {0, 0}}, {{"railway", "rail"}}),
                   way({{-1e300, 0}, {1e300, 0}, {0, 1e300}}, {{"railway", "rail"}}),
                   way({{0, 0}, {10, 0}, {0, 0}, {10, 0}, {5, 5}, {5, -5}},
                       {{"railway", "tram"}, {"gauge", "1e99"}}),
                   way(zigzag, {{"railway", "tram"}})},
                  {way({{nan, 0}, {1e9, 0}, {0, 1e9}}, {{"highway", "primary"}})});
  EXPECT_GT(cover.left_out_m.at("tracks beyond the first 4000 km"), 1e7);
  for (const auto& [name, m] : cover.tracks_m) EXPECT_TRUE(std::isfinite(m)) << name;
  areas_of(cover, middle);
}

}  // namespace
}  // namespace nightcity::ground_cover
