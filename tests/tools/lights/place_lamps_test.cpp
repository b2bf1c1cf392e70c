// Lamps on a plane beside a straight road, for which all values are known.
#include "tools/lights/place_lamps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <set>

#include "formats/rgb9e5.h"
#include "support/data.h"
#include "tools/lights/kept_schedules.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lamp_hours.h"
#include "tools/lights/road_index.h"
#include "tools/osm/read_osm.h"

namespace nightcity::lights {
namespace {

constexpr double metres_per_degree = 111320;

/// A flat Earth whose grid north is rotated by `convergence` degrees from true north.
place::LonLatToFrame flat_earth(double convergence_degrees = 0) {
  const double a = glm::radians(convergence_degrees);
  return [a](const glm::dvec2& lon_lat) {
    const glm::dvec2 p = lon_lat * metres_per_degree;
    return glm::dvec2(p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a));
  };
}

glm::dvec2 degrees(double x, double y) {
  return {x / metres_per_degree, y / metres_per_degree};
}

std::optional<double> ground(const glm::dvec2& p) {
  return std::abs(p.x) <= 500 && std::abs(p.y) <= 500 ? std::optional<double>(40.0) : std::nullopt;
}

osm::OsmLampNode lamp_at(double x, double y, osm::OsmTags tags = {}, std::int64_t id = 1) {
  tags["highway"] = "street_lamp";
  return {id, degrees(x, y), tags};
}

osm::OsmWay road(osm::OsmTags tags,
                 std::vector<glm::dvec2> line = {degrees(-300, 0), degrees(300, 0)}) {
  return {1, line, tags};
}

LampSet place(std::vector<osm::OsmLampNode> lamps, std::vector<osm::OsmWay> roads = {}) {
  osm::OsmData osm;
  osm.lamps = std::move(lamps);
  osm.highways = std::move(roads);
  return place_lamps(osm, flat_earth(), ground);
}

// The equator runs along the plane's middle; the long night is June's south of it.
TEST(Lamps, HoursByTheSeasonAreThoseOfTheLampsHalfOfTheEarth) {
  const osm::OsmTags tags{{"lit", "Oct-Mar 17:00-22:00; Apr-Sep 17:00-23:00"}};
  const LampSet set = place({lamp_at(0, 20, tags), lamp_at(0, -20, tags, 2)});
  ASSERT_EQ(set.lamps.size(), 2u);
  for (const PlacedLamp& lamp : set.lamps)
    EXPECT_EQ(lamp.hours->off[0], lamp.foot.y > 0 ? 300 : 360) << "minutes after 17:00";
}

TEST(Lamps, BareLampTakesItsValuesFromTheRoadBesideAndSaysSo) {
  const LampSet set = place({lamp_at(10, 5)}, {road({{"highway", "residential"}})});
  ASSERT_EQ(set.lamps.size(), 1u);
  const PlacedLamp& lamp = set.lamps[0];
  const RoadLighting defaults = *find_road_lighting("residential");
  EXPECT_NEAR(lamp.foot.x, 10, 1e-6);
  EXPECT_NEAR(lamp.foot.y, 5, 1e-6);
  EXPECT_EQ(lamp.foot.z, 40);
  EXPECT_EQ(lamp.mounting_height_m, defaults.mounting_m);
  EXPECT_EQ(lamp.flux_lm, defaults.flux_lm);
  EXPECT_EQ(lamp.cct_k, defaults.cct_k);
  EXPECT_NEAR(lamp.aim.x, 0, 1e-6);
  EXPECT_NEAR(lamp.aim.y, -1, 1e-6);  // the road lies south of it
  EXPECT_NEAR(lamp.outreach.y, -defaults.outreach_m, 1e-6);
  EXPECT_EQ(lamp.provenance.source_id, 1u);
  EXPECT_EQ(lamp.provenance.position, ValueSource::tag);
  EXPECT_EQ(lamp.provenance.height, ValueSource::rule);
  EXPECT_EQ(lamp.provenance.flux, ValueSource::rule);
  EXPECT_EQ(lamp.provenance.colour, ValueSource::rule);
  EXPECT_EQ(set.sources.at("road class").at("residential"), 1u);
}

TEST(Lamps, TagsWinOverTheRoadAndSaySo) {
  const LampSet set = place(
      {lamp_at(0, 5, {{"height", "7.5 m"}, {"lamp_type", "SON"}, {"lamp_mount", "straight_mast"}})},
      {road({{"highway", "residential"}})});
  const PlacedLamp& lamp = set.lamps.at(0);
  EXPECT_EQ(lamp.mounting_height_m, 7.5);
  EXPECT_EQ(lamp.provenance.height, ValueSource::tag);
  EXPECT_EQ(lamp.provenance.flux, ValueSource::tag);
  EXPECT_EQ(lamp.provenance.colour, ValueSource::tag);
  EXPECT_EQ(lamp.flux_lm, lamp_type_defaults(LampType::high_pressure_sodium).flux_lm[1]);
  EXPECT_GT(lamp.colour.r, 1.5f * lamp.colour.g);
}

TEST(Lamps, EveryRoadClassOfTheTableGivesPlausibleLamps) {
  for (const char* highway : {"motorway", "trunk_link", "primary", "secondary", "tertiary",
                              "unclassified", "residential", "living_street", "service",
                              "pedestrian", "footway", "cycleway", "path", "steps", "track"}) {
    const LampSet set = place({lamp_at(0, 4)}, {road({{"highway", highway}})});
    ASSERT_EQ(set.lamps.size(), 1u) << highway;
    EXPECT_GE(set.lamps[0].mounting_height_m, 3) << highway;
    EXPECT_LE(set.lamps[0].mounting_height_m, 15) << highway;
    EXPECT_GE(set.lamps[0].flux_lm, 800) << highway;
    EXPECT_LE(set.lamps[0].flux_lm, 30000) << highway;
  }
  for (const char* highway : {"proposed", "construction", "raceway", "rest_area", ""})
    EXPECT_FALSE(find_road_lighting(highway)) << highway;
}

TEST(Lamps, LampWithoutARoadStandsInTheOpen) {
  const LampSet set = place({lamp_at(0, 100)}, {road({{"highway", "primary"}})});
  EXPECT_EQ(set.lamps.at(0).mounting_height_m, open_space_defaults().mounting_m);
  EXPECT_NEAR(glm::length(set.lamps[0].aim), 1, 1e-9);
  EXPECT_EQ(set.sources.at("aim").at("no road near"), 1u);
}

TEST(Lamps, PavementMappedAsItsOwnWayDoesNotClaimTheStreetsLamps) {
  const std::vector<osm::OsmWay> roads = {
      road({{"highway", "secondary"}}),
      road({{"highway", "footway"}}, {degrees(-300, 6.5), degrees(300, 6.5)})};
  EXPECT_EQ(place({lamp_at(0, 5.3)}, roads).sources.at("road class").count("secondary"), 1u);
  EXPECT_EQ(place({lamp_at(0, 25)},
                  {roads[0], road({{"highway", "footway"}}, {degrees(-300, 26), degrees(300, 26)})})
                .sources.at("road class")
                .count("footway"),
            1u);
}

TEST(Lamps, SeveralLuminairesOnOnePostPointApart) {
  const LampSet twin =
      place({lamp_at(0, 5, {{"light:count", "2"}})}, {road({{"highway", "secondary"}})});
  ASSERT_EQ(twin.lamps.size(), 2u);
  EXPECT_NEAR(glm::dot(twin.lamps[0].aim, twin.lamps[1].aim), -1, 1e-9);
  EXPECT_NE(twin.lamps[0].id, twin.lamps[1].id);
  EXPECT_GT(glm::distance(twin.lamps[0].outreach, twin.lamps[1].outreach),
            twin.lamps[0].radius_m * 2);
  const LampSet four =
      place({lamp_at(0, 5, {{"light:count", "4"}})}, {road({{"highway", "secondary"}})});
  ASSERT_EQ(four.lamps.size(), 4u);
  EXPECT_NEAR(four.lamps[0].flux_lm * 4, twin.lamps[0].flux_lm * 2, 1e-6);
}

TEST(Lamps, EachDirectionHasItsLuminairesAndNoLightIsLost) {
  const auto at = [](const char* direction, const char* count) {
    osm::OsmTags tags{{"light:direction", direction}, {"light:luminous_flux", "6000"}};
    if (*count) tags["light:count"] = count;
    return place({lamp_at(0, 5, tags)}).lamps;
  };
  for (const char* count : {"", "1", "2"}) {
    const auto twin = at("90,270", count);
    ASSERT_EQ(twin.size(), 2u) << count;
    EXPECT_NEAR(twin[0].aim.x, 1, 1e-6);
    EXPECT_NEAR(twin[1].aim.x, -1, 1e-6);
    EXPECT_EQ(twin[0].flux_lm, 6000);
    EXPECT_EQ(twin[1].flux_lm, 6000);
  }
  // Four luminaires: two each way, sharing the light of two lamps as any cluster.
  const auto four = at("N;S", "4");
  ASSERT_EQ(four.size(), 4u);
  for (const std::size_t n : {0u, 1u, 2u, 3u}) {
    EXPECT_NEAR(four[n].aim.y, n % 2 == 0 ? 1 : -1, 1e-6);
    EXPECT_NEAR(four[n].flux_lm, 3000, 1e-9);
  }
}

TEST(Lamps, TaggedDirectionCountsFromTrueNorth) {
  osm::OsmData osm;
  osm.lamps = {lamp_at(0, 5, {{"direction", "E"}})};
  const LampSet set = place_lamps(osm, flat_earth(2), ground);  // grid north is two degrees off
  const double angle = std::atan2(set.lamps.at(0).aim.y, set.lamps[0].aim.x);
  EXPECT_NEAR(glm::degrees(angle), 2, 0.01);
}

TEST(Lamps, OfAPostThatIsMappedTwiceTheOneStaysOfWhichTheMapSaysMore) {
  const osm::OsmLampNode poor = lamp_at(0, 5, {}, 1),
                         rich = lamp_at(0.1, 5.1, {{"height", "7"}, {"light:count", "1"}}, 2);
  for (const auto& lamps : {std::vector{poor, rich}, std::vector{rich, poor}}) {
    const LampSet set = place(lamps);
    ASSERT_EQ(set.lamps.size(), 1u);
    EXPECT_EQ(set.lamps[0].mounting_height_m, 7);
    EXPECT_EQ(set.left_out.at("duplicate"), 1u);
  }
}

TEST(Lamps, WhatIsNotPlacedIsCountedByReason) {
  const LampSet set = place({lamp_at(0, 5), lamp_at(0.1, 5.1, {}, 2),
                             lamp_at(20, 5, {{"lit", "no"}}, 3), lamp_at(2000, 5, {}, 4),
                             lamp_at(0, NAN, {}, 5), lamp_at(40, 5, {{"height", "tall"}}, 6)});
  EXPECT_EQ(set.lamps.size(), 2u);
  EXPECT_EQ(set.left_out.at("duplicate"), 1u);
  EXPECT_EQ(set.left_out.at("lit=no"), 1u);
  EXPECT_EQ(set.left_out.at("outside the model"), 1u);
  EXPECT_EQ(set.left_out.at("outside the projection"), 1u);
  EXPECT_EQ(set.notes.at("tag not understood: height=tall"), 1u);
}

TEST(Lamps, LampInsideABuildingStepsOutTowardsItsRoad) {
  osm::OsmData osm;
  osm.lamps = {lamp_at(0, 9)};
  osm.highways = {road({{"highway", "residential"}})};
  const LampSet set =
      place_lamps(osm, flat_earth(), ground, [](const glm::dvec2& p) { return p.y > 6.1; });
  ASSERT_EQ(set.lamps.size(), 1u);
  EXPECT_LE(set.lamps[0].foot.y, 6.1);
  EXPECT_GE(set.lamps[0].foot.y, 5.8);
  EXPECT_EQ(set.lamps[0].provenance.position, ValueSource::rule);
  EXPECT_EQ(set.notes.at("moved out of a building"), 1u);
}

TEST(Lamps, IdentitiesStayWhateverElseIsInTheFile) {
  const LampSet one = place({lamp_at(0, 5, {}, 77)});
  const LampSet two = place({lamp_at(50, 5, {}, 12), lamp_at(0, 5, {}, 77)});
  EXPECT_EQ(one.lamps.at(0).id, two.lamps.at(1).id);
  std::vector<osm::OsmLampNode> many;
  for (int n = 0; n < 5000; ++n)
    many.push_back(lamp_at(n % 100 * 5 - 250, n / 100 * 5 - 100, {}, 1000 + n));
  std::set<std::uint32_t> ids;
  for (const PlacedLamp& lamp : place(many).lamps) ids.insert(lamp.id);
  EXPECT_EQ(ids.size(), 5000u);
}

TEST(Lamps, LightStandsInModelSpaceWithItsAxisDown) {
  const LampSet set = place({lamp_at(10, 5)}, {road({{"highway", "residential"}})});
  Georeference georeference;
  georeference.origin = {1, 2, 30};
  test::KeptSchedules kept;
  const Light light = to_light(set.lamps.at(0), georeference, kept.table);
  const RoadLighting defaults = *find_road_lighting("residential");
  EXPECT_NEAR(light.position.x, 9, 1e-4);
  EXPECT_NEAR(light.position.y, 10 + defaults.mounting_m, 1e-4);
  EXPECT_NEAR(light.position.z, -(5 - defaults.outreach_m - 2), 1e-4);
  EXPECT_NEAR(glm::distance(light.axis, glm::vec3(0, -1, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(light.tangent, glm::vec3(0, 0, 1)), 0, 1e-5);  // south, to the road
  EXPECT_EQ(light_kind(light), LightKind::sphere);
  EXPECT_LT(light_profile(light), set.profiles.size());
  EXPECT_FLOAT_EQ(light.flux_lm, static_cast<float>(defaults.flux_lm));
  EXPECT_NEAR(luminance(decode_rgb9e5(light.colour_rgb9e5)), 1, 0.01);
}

TEST(Lamps, TiltTurnsTheAxisTowardsTheAimAndKeepsTheFrameSquare) {
  const LampSet set =
      place({lamp_at(10, 5, {{"light:tilt", "-60"}})}, {road({{"highway", "residential"}})});
  test::KeptSchedules kept;
  const Light light = to_light(set.lamps.at(0), {}, kept.table);
  EXPECT_NEAR(light.axis.y, -std::cos(glm::radians(30.0)), 1e-5);
  EXPECT_NEAR(light.axis.z, 0.5, 1e-5);
  EXPECT_NEAR(glm::dot(light.axis, light.tangent), 0, 1e-6);
}

TEST(Lamps, MeasuredLuminaireServesTheRoadsItIsChosenFor) {
  osm::OsmData osm;
  osm.lamps = {lamp_at(0, 5), lamp_at(30, 5, {{"lamp_type", "SON"}}, 2), lamp_at(0, 105, {}, 3)};
  osm.highways = {road({{"highway", "primary"}}),
                  road({{"highway", "residential"}}, {degrees(-300, 100), degrees(300, 100)})};
  LampOptions options;
  options.luminaires.push_back({"measured",
                                sample_intensity([](double, double) { return 1; }, 4, 19),
                                {"primary"},
                                {},
                                true,
                                12345});
  const LampSet set = place_lamps(osm, flat_earth(), ground, {}, options);
  ASSERT_EQ(set.lamps.size(), 3u);
  EXPECT_EQ(set.lamps[0].flux_lm, 12345);
  EXPECT_EQ(set.lamps[0].provenance.profile, ValueSource::attribute);
  EXPECT_EQ(set.profiles.at(set.lamps[0].profile).c_count, 4u);
  EXPECT_NE(set.lamps[1].flux_lm, 12345);  // the tag overrides it
  EXPECT_EQ(set.lamps[1].profile, set.lamps[0].profile);
  EXPECT_NE(set.lamps[2].profile, set.lamps[0].profile);
}

TEST(Lamps, MeasuredLuminaireServesTheTypesOfLampItIsChosenFor) {
  osm::OsmData osm;
  osm.lamps = {lamp_at(0, 5), lamp_at(30, 5, {{"lamp_type", "SON"}}, 2),
               lamp_at(60, 5, {{"lamp_type", "led"}}, 3)};
  osm.highways = {road({{"highway", "primary"}})};
  LampOptions options;
  const Photometry even = sample_intensity([](double, double) { return 1; }, 4, 19);
  options.luminaires.push_back({"sodium", even, {}, {LampType::high_pressure_sodium}, true, 777});
  options.luminaires.push_back({"led", even, {}, {LampType::led}, false, 888});
  const LampSet set = place_lamps(osm, flat_earth(), ground, {}, options);
  EXPECT_EQ(set.lamps[0].profile, set.lamps[2].profile);  // an unknown type is LED
  EXPECT_NE(set.lamps[0].profile, set.lamps[1].profile);
  EXPECT_EQ(set.lamps[0].flux_lm, find_road_lighting("primary")->flux_lm);  // flux = false
}

TEST(Lamps, LuminaireDoesNotReachIntoABuilding) {
  osm::OsmData osm;
  osm.lamps = {lamp_at(0, 0, {{"direction", "180"}, {"lamp_mount", "bent_mast"}})};
  const place::InsideBuilding house = [](const glm::dvec2& p) {
    return p.y < -0.8;
  };  // nearer than the length of the arm
  const LampSet set = place_lamps(osm, flat_earth(), ground, house);
  ASSERT_EQ(set.lamps.size(), 1u);
  const glm::dvec2 centre = glm::dvec2(set.lamps[0].foot) + set.lamps[0].outreach;
  EXPECT_GT(centre.y, -0.8);
  EXPECT_LT(centre.y, -0.3);
  EXPECT_EQ(set.notes.at("luminaire drawn back from a building"), 1u);
}

TEST(LampHours, TagsTellHoursAndOtherLampsAreAlwaysOn) {
  const LampSet set =
      place({lamp_at(0, 5, {{"lit", "sunset-23:00"}}), lamp_at(30, 5, {{"lit", "limited"}}, 2),
             lamp_at(60, 5, {{"lit", "yes"}}, 3), lamp_at(90, 5, {{"lit", "when wet"}}, 4)});
  ASSERT_EQ(set.lamps.size(), 4u);
  ASSERT_TRUE(set.lamps[0].hours);
  EXPECT_TRUE(set.lamps[0].hours->lit_at(minute_of(22, 59)));
  EXPECT_FALSE(set.lamps[0].hours->lit_at(minute_of(23, 0)));
  EXPECT_EQ(set.lamps[0].provenance.schedule, ValueSource::tag);
  ASSERT_TRUE(set.lamps[1].hours);
  EXPECT_FALSE(set.lamps[1].hours->lit_at(minute_of(2, 0)));
  EXPECT_FALSE(set.lamps[2].hours);
  EXPECT_FALSE(set.lamps[3].hours);
  EXPECT_EQ(set.notes.at("tag not understood: lit=when wet"), 1u);
  test::KeptSchedules kept;
  EXPECT_EQ(to_light(set.lamps[2], {}, kept.table).schedule, LIGHT_ALWAYS_ON);
  EXPECT_EQ(to_light(set.lamps[0], {}, kept.table).schedule, 0u);
}

TEST(LampHours, EverySecondLampOfAHalfNightStreetGoesDarkWhateverTheOrderOfTheFile) {
  std::vector<osm::OsmLampNode> lamps;
  for (int n = 0; n < 9; ++n)
    lamps.push_back(lamp_at(-200 + 30 * ((n * 4) % 9), 5, {}, 10 + (n * 4) % 9));
  lamps.push_back(lamp_at(0, 105, {}, 50));
  LampSet set =
      place(lamps, {road({{"highway", "residential"}}),
                    {2, {degrees(-300, 100), degrees(300, 100)}, {{"highway", "service"}}}});
  LampHours hours;
  hours.half_night["residential"] = {minute_of(23, 0), minute_of(5, 0)};
  hours.off["service"] = {minute_of(0, 30), minute_of(4, 0)};
  switch_lamps(hours, set);
  for (const PlacedLamp& lamp : set.lamps) {
    const auto id = static_cast<int>(lamp.provenance.source_id);
    if (id == 50) {
      ASSERT_TRUE(lamp.hours);
      EXPECT_FALSE(lamp.hours->lit_at(minute_of(2, 0)));
      EXPECT_TRUE(lamp.hours->lit_at(minute_of(0, 29)));
    } else {
      EXPECT_EQ(lamp.hours.has_value(), id % 2 == 1) << id;  // the 2nd, 4th, ... from the west
      if (lamp.hours) {
        EXPECT_FALSE(lamp.hours->lit_at(minute_of(2, 0)));
      }
    }
  }
  EXPECT_EQ(set.sources.at("hours").at("rule"), 10u);
}

TEST(LampHours, LuminairesOfOnePostGoTogether) {
  std::vector<osm::OsmLampNode> lamps;
  for (int n = 0; n < 4; ++n) lamps.push_back(lamp_at(30 * n, 5, {{"light:count", "2"}}, 10 + n));
  LampSet set = place(lamps, {road({{"highway", "residential"}})});
  LampHours hours;
  hours.half_night["residential"] = {minute_of(23, 0), minute_of(5, 0)};
  switch_lamps(hours, set);
  ASSERT_EQ(set.lamps.size(), 8u);
  for (const PlacedLamp& lamp : set.lamps)
    EXPECT_EQ(lamp.hours.has_value(), lamp.provenance.source_id % 2 == 1);
}

TEST(LampsReal, EveryBerlinLampIsPlacedOrCounted) {
  REAL_DATA(file, "berlin/berlin_dev_box.osm.pbf");
  const osm::OsmData osm = osm::read_osm(file);
  const LampSet set = place_lamps(
      osm, [](const glm::dvec2& p) { return glm::dvec2(p.x * 68000, p.y * 111000); },
      [](const glm::dvec2&) { return std::optional<double>(35); });
  std::size_t left_out = 0;
  for (const auto& [reason, count] : set.left_out) left_out += count;
  EXPECT_GE(set.lamps.size() + left_out, osm.lamps.size());
  EXPECT_GT(set.lamps.size(), 200u);
  EXPECT_GT(set.sources.at("road class").size(), 2u);
}

}  // namespace
}  // namespace nightcity::lights
