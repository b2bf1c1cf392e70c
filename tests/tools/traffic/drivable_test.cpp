#include "tools/traffic/drivable.h"

#include <gtest/gtest.h>

namespace nightcity::traffic {
namespace {

const Country& germany = country_at({13.4, 52.5});

Drivable read(osm::OsmTags tags, const Country& country = germany) {
  std::string why;
  const auto result = read_drivable({1, {{0, 0}, {1, 0}}, std::move(tags)}, country, why);
  EXPECT_TRUE(result) << why;
  return result.value_or(Drivable{});
}

std::string refusal(osm::OsmTags tags) {
  std::string why;
  EXPECT_FALSE(read_drivable({1, {{0, 0}, {1, 0}}, std::move(tags)}, germany, why));
  return why;
}

TEST(Speed, IsReadAsPeopleWriteIt) {
  const std::pair<const char*, double> texts[] = {
      {"50", 50},        {"30 mph", 48.28}, {"20mph", 32.19},   {"walk", 7},
      {"DE:walk", 7},    {"none", 130},     {"DE:urban", 50},   {"DE:zone:30", 30},
      {"DE:zone30", 30}, {"50;30", 50},     {"50 km/h", 50},    {"GB:nsl_single", 96.56},
      {"12.5", 12.5},    {"DE:rural", 90},  {"NL:zone:20", 20}, {"living_street", 7}};
  for (const auto& [text, kmh] : texts) {
    const auto value = parse_speed_kmh(text);
    ASSERT_TRUE(value) << text;
    EXPECT_NEAR(*value, kmh, 0.01) << text;
  }
  for (const char* text : {"", "signals", "variable", "0", "-5", "900", "fast", "mph", "30 knots"})
    EXPECT_FALSE(parse_speed_kmh(text)) << text;
}

TEST(Drivable, OneWayByTagClassAndRoundabout) {
  const auto lanes = [](osm::OsmTags tags) {
    const Drivable d = read(std::move(tags));
    return std::pair(d.carriageway.lanes[0] > 0, d.carriageway.lanes[1] > 0);
  };
  EXPECT_EQ(lanes({{"highway", "residential"}}), std::pair(true, true));
  EXPECT_EQ(lanes({{"highway", "residential"}, {"oneway", "yes"}}), std::pair(true, false));
  EXPECT_EQ(lanes({{"highway", "residential"}, {"oneway", "-1"}}), std::pair(false, true));
  EXPECT_EQ(lanes({{"highway", "motorway"}}), std::pair(true, false));
  EXPECT_EQ(lanes({{"highway", "motorway"}, {"oneway", "no"}}), std::pair(true, true));
  EXPECT_EQ(lanes({{"highway", "tertiary"}, {"junction", "roundabout"}}), std::pair(true, false));
}

TEST(Drivable, LanesAreSharedOut) {
  const Drivable plain = read({{"highway", "primary"}, {"lanes", "4"}});
  EXPECT_EQ(plain.carriageway.lanes[0], 2);
  EXPECT_EQ(plain.carriageway.lanes[1], 2);
  const Drivable split = read({{"highway", "primary"}, {"lanes", "3"}, {"lanes:forward", "2"}});
  EXPECT_EQ(split.carriageway.lanes[0], 2);
  EXPECT_EQ(split.carriageway.lanes[1], 1);
  const Drivable narrow = read({{"highway", "residential"}, {"lanes", "1"}});
  EXPECT_EQ(narrow.carriageway.lanes[0], 1);
  EXPECT_EQ(narrow.carriageway.lanes[1], 1);
  const Drivable oneway = read({{"highway", "primary"}, {"lanes", "3"}, {"oneway", "yes"}});
  EXPECT_EQ(oneway.carriageway.lanes[0], 3);
  EXPECT_EQ(oneway.carriageway.lanes[1], 0);
  const Drivable silly =
      read({{"highway", "residential"}, {"lanes", "999999999999"}, {"width", "-3"}});
  EXPECT_EQ(silly.carriageway.lanes[0] + silly.carriageway.lanes[1], 2);
  EXPECT_GT(silly.carriageway.lane_m(), 2);
}

TEST(Drivable, SpeedsComeFromTagsOrTheCountry) {
  EXPECT_NEAR(read({{"highway", "residential"}}).speed_m_s[0] * 3.6, 50, 1e-9);
  const Drivable both =
      read({{"highway", "primary"}, {"maxspeed", "70"}, {"maxspeed:backward", "50"}});
  EXPECT_NEAR(both.speed_m_s[0] * 3.6, 70, 1e-9);
  EXPECT_NEAR(both.speed_m_s[1] * 3.6, 50, 1e-9);
  EXPECT_NEAR(read({{"highway", "residential"}}, country_at({135.5, 34.7})).speed_m_s[0] * 3.6, 30,
              1e-9);
  EXPECT_NEAR(read({{"highway", "motorway"}}, country_at({-0.1, 51.5})).speed_m_s[0] * 3.6, 113,
              1e-9);
}

TEST(Drivable, WhatIsNotForThePublicIsLeftOut) {
  EXPECT_EQ(refusal({{"highway", "footway"}}), "not for motor vehicles");
  EXPECT_EQ(refusal({{"highway", "proposed"}}), "not for motor vehicles");
  EXPECT_EQ(refusal({{"highway", "residential"}, {"access", "private"}}), "no access");
  EXPECT_EQ(refusal({{"highway", "residential"}, {"motor_vehicle", "no"}}), "no access");
  EXPECT_EQ(refusal({{"highway", "residential"}, {"disused", "yes"}}), "disused");
  EXPECT_EQ(refusal({{"highway", "service"}, {"service", "driveway"}}), "driveway or aisle");
  EXPECT_EQ(refusal({{"highway", "service"}, {"tunnel", "building_passage"}}),
            "through a building");
  // The more specific tag wins.
  read({{"highway", "residential"}, {"access", "no"}, {"motor_vehicle", "yes"}});
}

TEST(Country, SideOfTheRoadByPlace) {
  const std::tuple<const char*, double, double, Side> places[] = {
      {"Berlin", 13.4, 52.5, Side::right},    {"London", -0.1, 51.5, Side::left},
      {"Dublin", -6.26, 53.35, Side::left},   {"Osaka", 135.5, 34.7, Side::left},
      {"Calais", 1.85, 50.95, Side::right},   {"Seattle", -122.3, 47.6, Side::right},
      {"Sydney", 151.2, -33.9, Side::left},   {"Helsinki", 24.9, 60.2, Side::right},
      {"Paris", 2.35, 48.85, Side::right},    {"Busan", 129.0, 35.2, Side::right},
      {"Singapore", 103.8, 1.35, Side::left}, {"Fukuoka", 130.4, 33.6, Side::left}};
  for (const auto& [name, lon, lat, side] : places)
    EXPECT_EQ(country_at({lon, lat}).side, side) << name;
}

TEST(Tables, AreWithinReason) {
  for (const char* highway :
       {"motorway", "trunk", "primary", "secondary", "tertiary", "residential", "service"}) {
    const roads::RoadClass* road = roads::find_road_class(highway);
    ASSERT_TRUE(road && find_traffic_class(highway)) << highway;
    const double kmh = default_speed_kmh(*road, germany);
    EXPECT_GE(kmh, 7) << highway;
    EXPECT_LE(kmh, 130) << highway;
  }
  float most = 0;
  for (const float share : flow_by_hour) {
    EXPECT_GT(share, 0);
    most = std::max(most, share);
  }
  EXPECT_EQ(most, 1);
}

}  // namespace
}  // namespace nightcity::traffic
