// The use of buildings, by their codes and by the map.
#include "tools/lights/building_use.h"

#include <gtest/gtest.h>

#include "tools/lights/osm_uses.h"
#include "tools/lights/window_houses.h"

namespace nightcity::lights {
namespace {

using namespace test;

TEST(BuildingUse, CodesAndWordsOfRealModels) {
  const struct {
    const char* code;
    BuildingUse use;
  } known[] = {{"31001_1010", BuildingUse::residential},
               {"31001_1120", BuildingUse::mixed},
               {"31001_2020", BuildingUse::office},
               {"31001_2463", BuildingUse::dark},
               {"31001_3041", BuildingUse::dark},
               {"31001_3021", BuildingUse::education},
               {"31001_3012", BuildingUse::civic},
               {"31001_2071", BuildingUse::hotel},
               {"31001_2143", BuildingUse::industrial},
               {"401", BuildingUse::office},
               {"411", BuildingUse::residential},
               {"441", BuildingUse::industrial},
               {"1000", BuildingUse::residential},
               {"1120", BuildingUse::office},
               {"Wohnhaus", BuildingUse::residential},
               {"Office building", BuildingUse::office},
               {"Garage", BuildingUse::dark},
               {"Shop", BuildingUse::retail}};
  for (const auto& [code, use] : known) {
    EXPECT_TRUE(use_from_code(code).stated) << code;
    EXPECT_EQ(use_from_code(code).use, use) << code;
  }
  for (const char* code : {"", "9999", "31001_", "31001_0", "???"})
    EXPECT_FALSE(use_from_code(code).stated) << code;
  city::CityObject hut = make_house(0, 0, 4, 4, 2.5);
  hut.function.clear();
  EXPECT_EQ(use_of(hut).use, BuildingUse::dark);
}

TEST(BuildingUse, TheMapSpeaksWhereTheModelIsSilent) {
  const auto outline = [](double x0, double y0, double x1, double y1, osm::OsmTags tags) {
    return osm::OsmWay{1, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}, std::move(tags)};
  };
  const OsmUses uses({outline(0, 0, 100, 100, {{"building", "retail"}}),
                      outline(10, 10, 20, 20, {{"building", "office"}}),
                      outline(200, 0, 300, 50, {{"building", "yes"}, {"tourism", "hotel"}}),
                      outline(400, 0, 500, 50, {{"building", "yes"}}),
                      {2, {{600, 0}, {700, 0}, {700, 50}}, {{"building", "retail"}}}},
                     {}, [](const glm::dvec2& p) { return glm::dvec2(east, north) + p; });
  const auto at = [&](double x, double y) { return uses.at({east + x, north + y}); };
  EXPECT_EQ(at(50, 50), BuildingUse::retail);
  EXPECT_EQ(at(15, 15), BuildingUse::office);  // the smaller outline
  EXPECT_EQ(at(250, 25), BuildingUse::hotel);
  EXPECT_FALSE(at(450, 25));
  EXPECT_FALSE(at(690, 10));  // not closed
  EXPECT_FALSE(at(-1, 50));
  city::CityObject house = make_house(40, 40, 60, 60, 9);
  const UseAt map = [&](const glm::dvec2& p) { return uses.at(p); };
  EXPECT_EQ(use_of(house, map).use, BuildingUse::residential);  // the model comes first
  house.function.clear();
  EXPECT_EQ(use_of(house, map).use, BuildingUse::retail);
  EXPECT_TRUE(use_of(house, map).from_map);
  EXPECT_EQ(use_from_tags({{"building", "Semidetached House"}}), BuildingUse::residential);
  EXPECT_EQ(use_from_tags({{"building", "yes"}, {"amenity", "school"}}), BuildingUse::education);
  EXPECT_EQ(use_from_tags({{"building", "church"}, {"shop", "kiosk"}}), BuildingUse::dark);
  for (const char* without_rooms : {"silo", "storage_tank", "cowshed", "farm_auxiliary", "mosque",
                                    "temple", "water_tower", "hangar", "ruins"})
    EXPECT_EQ(use_from_tags({{"building", without_rooms}}), BuildingUse::dark) << without_rooms;
  EXPECT_EQ(use_from_tags({{"building", "static_caravan"}}), BuildingUse::residential);
}

TEST(BuildingUse, AHouseRoundACourtyardHasTheUseOfItsMultipolygon) {
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return std::vector<glm::dvec2>{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  };
  // A block of offices with a gap to the east of its courtyard, in which a shop stands; beyond it
  // two more rings of the same relation.
  const osm::MapArea block{
      "relation/1",
      {{"building", "office"}, {"type", "multipolygon"}},
      {{rectangle(0, 0, 100, 100), {rectangle(30, 30, 90, 70)}}, {rectangle(200, 0, 240, 30), {}}}};
  const osm::MapArea unknown{
      "relation/2", {{"building", "yes"}}, {{rectangle(300, 0, 340, 30), {}}}};
  const OsmUses uses(
      {{1, {{50, 40}, {70, 40}, {70, 60}, {50, 60}, {50, 40}}, {{"building", "retail"}}}},
      {block, unknown}, [](const glm::dvec2& p) { return glm::dvec2(east, north) + p; });
  const UseAt map = [&](const glm::dvec2& p) { return uses.at(p); };
  EXPECT_EQ(uses.at({east + 15, north + 50}), BuildingUse::office);
  EXPECT_EQ(uses.at({east + 220, north + 15}), BuildingUse::office);
  EXPECT_EQ(uses.at({east + 60, north + 50}), BuildingUse::retail);
  EXPECT_FALSE(uses.at({east + 40, north + 50})) << "the courtyard";
  EXPECT_FALSE(uses.at({east + 320, north + 15}));

  // The middle of the house's box lies in its courtyard, on the shop.
  city::CityObject house = make_house(0, 0, 100, 100, 20);
  house.function.clear();
  for (const glm::dvec2& p : rectangle(30, 30, 90, 70))
    house.polygons.back().interiors.resize(1),
        house.polygons.back().interiors[0].emplace_back(east + p.x, north + p.y, ground_z + 20);
  EXPECT_EQ(use_of(house, map).use, BuildingUse::office);
  EXPECT_TRUE(use_of(house, map).from_map);
  city::CityObject shop = make_house(50, 40, 70, 60, 5);
  shop.function.clear();
  EXPECT_EQ(use_of(shop, map).use, BuildingUse::retail);
  city::CityObject other = make_house(75, 40, 85, 60, 5);
  other.function.clear();
  EXPECT_FALSE(use_of(other, map).from_map) << "it stands in the courtyard";
  // An L of two roofs round a neighbour.
  city::CityObject l_shape = make_house(0, 0, 100, 25, 20);
  l_shape.function.clear();
  const city::CityObject wing = make_house(0, 25, 28, 100, 20);
  for (const city::Polygon& polygon : wing.polygons) l_shape.polygons.push_back(polygon);
  EXPECT_EQ(use_of(l_shape, map).use, BuildingUse::office);
}

}  // namespace
}  // namespace nightcity::lights
