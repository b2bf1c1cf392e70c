// Parking lanes along streets: areas and paint.
#include <gtest/gtest.h>

#include "tests/tools/ground_cover/plan_areas.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::ground_cover {
namespace {

osm::OsmWay street(std::vector<glm::dvec2> line, osm::OsmTags tags) {
  tags.emplace("highway", "residential");
  return {1, std::move(line), std::move(tags)};
}

Cover cover_parking(const std::vector<osm::OsmWay>& ways, bool parking = true,
                    bool on_the_left = false) {
  Cover cover;
  add_streets(ways, parking, as_metres, bounds, cover);
  add_markings({ways, {}, {}, on_the_left, parking}, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

Cover make_street(osm::OsmTags tags, bool parking = true, bool on_the_left = false) {
  return cover_parking({street({{-200, 0}, {200, 0}}, std::move(tags))}, parking, on_the_left);
}

TEST(StreetParking, BaysWidenTheCarriagewayAndThePavementLiesBeyond) {
  const Cover cover =
      make_street({{"parking:both", "street_side"}, {"parking:both:orientation", "parallel"}});
  const auto areas = areas_of(cover, middle);
  EXPECT_NEAR(areas.at("asphalt"), 100 * (5.5 + 2 * 2.0), 0.2);
  EXPECT_NEAR(areas.at("sunken"), 100 * (5.5 + 2 * 2.0), 0.2);
  EXPECT_NEAR(areas.at("paving stones"), 100 * 2 * 2.5, 0.3);
  EXPECT_NEAR(cover.parking_m.at("street side, parallel"), 800, 1e-9);
}

TEST(StreetParking, ABayIsOfItsOwnSurfaceAndOnItsOwnSide) {
  const Cover cover = make_street({{"parking:left", "street_side"},
                                   {"parking:left:orientation", "perpendicular"},
                                   {"parking:left:surface", "sett"},
                                   {"sidewalk", "no"}});
  EXPECT_NEAR(areas_of(cover, middle).at("sett"), 100 * 4.30, 0.2);
  EXPECT_EQ(cover.surface_at({0, 2.75 + 4.2})->kind, GroundKind::sett)
      << "left of the way is north";
  EXPECT_EQ(cover.surface_at({0, -2.75 - 0.1}), nullptr);
}

TEST(StreetParking, BaysEndBeforeJunctionsAndAtEntrances) {
  const osm::OsmTags bays{{"parking:right", "street_side"}, {"sidewalk", "no"}};
  const auto asphalt_of = [&](osm::OsmTags side) {
    side.emplace("sidewalk", "no");
    const Cover cover = cover_parking(
        {street({{-200, 0}, {0, 0}, {200, 0}}, bays), street({{0, 0}, {0, 200}}, std::move(side))});
    return areas_of(cover, {{-50, -40}, {50, 2}}).at("asphalt");
  };
  const double carriageway_m2 = 100 * (2.75 + 2);
  EXPECT_NEAR(asphalt_of({}), carriageway_m2 + (100 - 2 * (2.75 + 5)) * 2, 0.2);
  EXPECT_NEAR(asphalt_of({{"highway", "service"}, {"width", "4.4"}}),
              carriageway_m2 + (100 - 4.4) * 2, 0.2);
}

TEST(StreetParking, ALaneWidensACarriagewayWhoseWidthNobodySays) {
  const Cover cover = make_street({{"parking:lane:both", "parallel"}});
  EXPECT_NEAR(areas_of(cover, middle).at("asphalt"), 100 * (5.5 + 2 * 2.0), 0.2);
  EXPECT_NEAR(areas_of(cover, middle).at("paving stones"), 100 * 2 * 2.5, 0.3);
  EXPECT_EQ(cover.assumed.at("width of a street on which cars park"), 1u);
}

TEST(StreetParking, ALaneLiesWithinACarriagewayWhoseWidthIsTagged) {
  const Cover with = make_street({{"parking:lane:both", "parallel"}, {"width", "10"}}),
              without = make_street({{"width", "10"}});
  EXPECT_EQ(areas_of(with, middle), areas_of(without, middle));
  EXPECT_FALSE(with.assumed.contains("width of a street on which cars park"));
  EXPECT_NEAR(with.parking_m.at("lane, parallel"), 800, 1e-9);
}

TEST(StreetParking, APavementIsAsWideAsTheCarsOnItNeed) {
  const auto pavement_m = [](osm::OsmTags tags) {
    return areas_of(make_street(std::move(tags)), middle)["paving stones"] / 100;
  };
  EXPECT_NEAR(pavement_m({{"sidewalk", "no"}, {"parking:right", "half_on_kerb"}}), 1, 1e-2);
  EXPECT_NEAR(pavement_m({{"sidewalk", "no"}, {"parking:right", "on_kerb"}}), 2, 1e-2);
  EXPECT_NEAR(pavement_m({{"parking:right", "on_kerb"}}), 5, 1e-2) << "it is wide enough";
  EXPECT_NEAR(
      pavement_m({{"parking:both", "on_kerb"}, {"parking:both:orientation", "perpendicular"}}),
      2 * 4.30, 1e-2);
}

TEST(StreetParking, OneWordTurnsItOff) {
  const osm::OsmTags tags{{"parking:both", "street_side"}, {"parking:both:markings", "yes"}};
  const Cover cover = make_street(tags, false);
  EXPECT_EQ(areas_of(cover, middle), areas_of(make_street({}), middle));
  EXPECT_TRUE(cover.parking_m.empty());
}

TEST(StreetParking, MarkedBaysHaveLinesBetweenThem) {
  const Cover cover = make_street({{"parking:right", "street_side"},
                                   {"parking:right:orientation", "perpendicular"},
                                   {"parking:right:markings", "yes"}});
  // 400 m hold 160 bays of 2.50 m, which have 161 lines.
  EXPECT_EQ(cover.markings.at("line between parking bays"), 161u);
  EXPECT_NEAR(areas_of(cover, {{-50.01, -40}, {49.99, 40}}).at("paint"), 40 * 0.12 * 4.30, 0.6);
}

TEST(StreetParking, ALaneThatIsMarkedHasALineAlongIt) {
  const Cover cover = make_street({{"parking:lane:left", "marked"}});
  EXPECT_NEAR(areas_of(cover, {{-1, 1.6}, {1, 1.9}}).at("paint"), 2 * 0.12, 0.02)
      << "two metres within the carriageway of 7.5 m";
  EXPECT_EQ(cover.markings.at("line between parking bays"), 71u) << "400 m hold 70 bays of 5.70 m";
}

TEST(StreetParking, LinesBetweenLanesLieBetweenThoseThatAreDriven) {
  const Cover cover = make_street({{"highway", "tertiary"}, {"parking:right", "lane"}});
  // The carriageway reaches 4 m to each side, and cars park on the last two to the right.
  EXPECT_NEAR(areas_of(cover, {{-50, 0.9}, {50, 1.1}}).at("paint"), 100 / 9.0 * 3 * 0.12, 0.8);
  EXPECT_FALSE(areas_of(cover, {{-50, -0.5}, {50, 0.5}}).contains("paint"));
}

TEST(StreetParking, DiagonalBaysLeanTheWayThatVehiclesDrive) {
  // Returns by how much the far ends of lines lie further along the way than their near ends, m.
  const auto lean_m = [](const char* side, osm::OsmTags tags, bool on_the_left) {
    const std::string key = std::string("parking:") + side;
    tags.insert(
        {{key, "street_side"}, {key + ":orientation", "diagonal"}, {key + ":markings", "yes"}});
    const Cover cover = make_street(std::move(tags), true, on_the_left);
    const auto line = cover.find_part(bounds, {0, 0}).markings.at(20).rings.at(0);
    double near = 0, far = 0;
    for (const glm::dvec2& p : line) (std::abs(p.y) < 3 ? near : far) += p.x / 2;
    return far - near;
  };
  constexpr double lean = 4.60 * 0.510;
  EXPECT_NEAR(lean_m("right", {}, false), lean, 2e-3);
  EXPECT_NEAR(lean_m("left", {}, false), -lean, 2e-3);
  EXPECT_NEAR(lean_m("right", {}, true), -lean, 2e-3);
  EXPECT_NEAR(lean_m("left", {{"oneway", "yes"}}, false), lean, 2e-3);
}

TEST(StreetParking, AreasOfTheirOwnAreCountedInMetres) {
  const Cover cover = make_street({{"parking:both", "separate"}});
  EXPECT_NEAR(cover.left_out_m.at("parking lanes mapped as areas"), 800, 1e-9);
  EXPECT_TRUE(cover.parking_m.empty());
}

}  // namespace
}  // namespace nightcity::ground_cover
