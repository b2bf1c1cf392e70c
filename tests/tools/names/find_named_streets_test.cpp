// Named streets of small maps whose coordinates are metres.
#include "tools/names/find_named_streets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "formats/scene_places_json.h"

namespace nightcity::names {
namespace {

using osm::OsmTags;

osm::OsmWay way(std::vector<glm::dvec2> line, const std::string& name, OsmTags more = {}) {
  OsmTags tags{{"highway", "residential"}, {"name", name}};
  for (auto& [key, value] : more) tags[key] = value;
  return {1, std::move(line), tags};
}

struct Map {
  std::vector<osm::OsmWay> highways;
  std::vector<osm::MapArea> squares;
  std::vector<osm::OsmPoint> nodes;

  NamedStreets find(double size_m = 1000) const {
    Georeference georeference;
    georeference.origin = {100, 200, 0};
    return find_named_streets(
        {highways, squares, nodes}, [](const glm::dvec2& p) { return p; },
        {{0, 0}, {size_m, size_m}}, georeference);
  }
};

TEST(NamedStreets, AreLinesInModelSpaceThatEndWhereTheModelEnds) {
  const NamedStreets found = Map{
      {way({{-500, 300}, {600, 300}}, "Hauptstraße"), way({{600, 300}, {600, 900}}, "Hauptstraße"),
       way({{2000, 0}, {3000, 0}}, "Beyond")},
      {},
      {}}.find();
  ASSERT_EQ(found.streets.size(), 1u);
  EXPECT_EQ(found.names, 1u);
  EXPECT_EQ(found.streets[0].name, "Hauptstraße");
  // x = easting - 100, z = 200 - northing: SPEC.md, section 1.
  const std::vector<std::vector<glm::dvec2>> line{{{-100, -100}, {500, -100}, {500, -700}}};
  EXPECT_EQ(found.streets[0].lines, line);
  EXPECT_EQ(found.points, 3u);
  EXPECT_TRUE(found.left_out.empty());
}

TEST(NamedStreets, OtherNamesAreThoseOfTheTagsForNames) {
  const NamedStreets found = Map{
      {way({{0, 10}, {50, 10}}, "Karl-Marx-Allee",
           {{"old_name", "Stalinallee;Große Frankfurter Straße"}, {"ref", "B 1"}}),
       way({{50, 10}, {90, 10}}, "Karl-Marx-Allee",
           {{"name:en", "Karl Marx Avenue"},
            {"alt_name", "Karl-Marx-Allee"},
            {"name:ru", "\x1b[31m"},
            {"name:sr-Latn", "Aleja Karla Marksa"},
            {"name:etymology:wikidata", "Q9061"},
            {"name:etymology:wikipedia", "de:Karl Marx"},
            {"name:pronunciation", "karl"},
            {"surface", "asphalt"},
            {"ref", "B 1"}}),
       way({{0, 500}, {50, 500}}, "Plain")},
      {},
      {}}.find();
  ASSERT_EQ(found.streets.size(), 2u);
  EXPECT_EQ(found.streets[0].also,
            (std::vector<std::string>{"Aleja Karla Marksa", "B 1", "Große Frankfurter Straße",
                                      "Karl Marx Avenue", "Stalinallee"}));
  EXPECT_TRUE(found.streets[1].also.empty());
  EXPECT_EQ(found.other_names, 5u);
}

TEST(NamedStreets, OfOneNameThatLieApartAreSeveral) {
  Map map{{way({{0, 10}, {50, 10}}, "Park Road"), way({{0, 20}, {50, 20}}, "Park Road")}, {}, {}};
  EXPECT_EQ(map.find().streets.size(), 1u);
  EXPECT_EQ(map.find().streets[0].lines.size(), 2u);
  map.highways.push_back(way({{9000, 9000}, {9100, 9000}}, "Park Road"));
  const NamedStreets found = map.find(10'000);
  EXPECT_EQ(found.names, 1u);
  EXPECT_EQ(found.streets.size(), 2u);
}

TEST(NamedStreets, SquaresArePointsInsideThem) {
  // A ring shaped as a U, whose centroid lies outside.
  const std::vector<glm::dvec2> u{{400, 400}, {700, 400}, {700, 700}, {600, 700},
                                  {600, 420}, {500, 420}, {500, 700}, {400, 700}};
  const Map map{{way({{10, 10}, {20, 10}, {20, 20}, {10, 10}}, "Area", {{"area", "yes"}})},
                {{"way/7", {{"place", "square"}, {"name", "U"}}, {{u, {}}}},
                 {"way/8",
                  {{"place", "square"}, {"name", "Markt"}},
                  {{{{100, 100}, {120, 100}, {120, 130}, {100, 130}}, {}}}}},
                {{{500, 900}, {{"place", "square"}, {"name", "Node"}}},
                 {{5000, 900}, {{"place", "square"}, {"name", "Far"}}}}};
  const NamedStreets found = map.find();
  ASSERT_EQ(found.streets.size(), 3u);  // an area that is a highway is read as an area, too
  EXPECT_EQ(found.streets[0].name, "Markt");
  EXPECT_EQ(found.streets[0].lines[0], (std::vector<glm::dvec2>{{10, 200 - 115}}));
  EXPECT_EQ(found.streets[1].name, "Node");
  EXPECT_EQ(found.streets[2].name, "U");
  const glm::dvec2 inner = found.streets[2].lines[0][0] + glm::dvec2(100, 0);
  EXPECT_TRUE((inner.x > 400 && inner.x < 500) || (inner.x > 600 && inner.x < 700)) << inner.x;
}

TEST(NamedStreets, WhatCannotBeShownIsCountedOrNoStreet) {
  const NamedStreets found = Map{
      {way({{0, 10}, {50, 10}}, "Below", {{"tunnel", "yes"}}),
       way({{0, 10}, {50, 10}}, "Passage", {{"tunnel", "building_passage"}}),
       way({{0, 10}, {50, 10}}, "Planned", {{"highway", "proposed"}}),
       way({{0, 10}, {50, 10}}, "\x1b[31mred"), way({{0, 10}, {50, 10}}, ""),
       way({{0, 10}, {50, 10}}, std::string(1021, 'x'))},
      {},
      {}}.find();
  ASSERT_EQ(found.streets.size(), 1u);
  EXPECT_EQ(found.streets[0].name, "Passage");
  EXPECT_EQ(found.left_out.at("below the ground"), 1u);
  EXPECT_EQ(found.left_out.at("name of over 1020 bytes or with control characters"), 2u);
}

TEST(NamedStreets, DependOnTheOrderOfTheMapInNothing) {
  Map map;
  for (int i = 0; i < 40; ++i)
    map.highways.push_back(
        way({{25.0 * i, 10}, {25.0 * i + 12, 15}, {25.0 * i + 25, 10}}, i % 3 == 0 ? "A" : "B"));
  const auto text_of = [](const NamedStreets& found) {
    std::string text;
    for (const NamedStreet& street : found.streets) {
      text += street.name;
      for (const auto& line : street.lines)
        for (const glm::dvec2& p : line) text += std::to_string(p.x) + " " + std::to_string(p.y);
    }
    return text;
  };
  const std::string once = text_of(map.find());
  std::reverse(map.highways.begin(), map.highways.end());
  EXPECT_EQ(text_of(map.find()), once);
}

TEST(NamedStreets, AreBoundedInNumber) {
  // Zigzags that do not simplify: 1,001 lines of 1,000 points, each with a name of its own.
  Map map;
  for (int i = 0; i < 1001; ++i) {
    std::vector<glm::dvec2> zigzag;
    for (int k = 0; k < 1000; ++k) zigzag.emplace_back(k, k % 2 == 0 ? 0 : 900);
    map.highways.push_back(way(zigzag, "Street " + std::to_string(i)));
  }
  const NamedStreets found = map.find();
  EXPECT_EQ(found.points, max_street_points);
  EXPECT_EQ(found.left_out.at("beyond 1,000,000 points"), 1u);
}

}  // namespace
}  // namespace nightcity::names
