// Tests that multipolygons of the map say what buildings of the model are used for.
#include "tools/bake/city/building_uses.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "support/temp_folder.h"
#include "tests/tools/bake/two_files.h"
#include "tools/bake/city/city_survey.h"

namespace nightcity::bake {
namespace {

using lights::BuildingUse;
using test::TempFolder;

std::string tag(const char* key, const char* value) {
  return std::string("<tag k='") + key + "' v='" + value + "'/>";
}

// The outline of the sample's cube in two ways of these tags, in a relation of those.
std::string write_relation(const City& city, const std::string& of_ways,
                           const std::string& of_relation) {
  constexpr std::array<std::array<double, 2>, 4> corners{
      {{391000, 5819000}, {391010, 5819000}, {391010, 5819010}, {391000, 5819010}}};
  std::string text = "<osm version='0.6'>";
  for (int i = 0; i < 4; ++i) {
    const glm::dvec2 p = city.frame().to_lon_lat({corners[i][0], corners[i][1]});
    char node[128];
    std::snprintf(node, sizeof node, "<node id='%d' version='1' lat='%.7f' lon='%.7f'/>", i + 1,
                  p.y, p.x);
    text += node;
  }
  return text + "<way id='1' version='1'><nd ref='1'/><nd ref='2'/><nd ref='3'/>" + of_ways +
         "</way><way id='2' version='1'><nd ref='3'/><nd ref='4'/><nd ref='1'/>" + of_ways +
         "</way><relation id='7' version='1'><member type='way' ref='1' role='outer'/>"
         "<member type='way' ref='2' role='outer'/>" +
         tag("type", "multipolygon") + of_relation + "</relation></osm>";
}

TEST(BuildingUses, AMultipolygonSaysWhatABuildingOfTheModelIsUsedFor) {
  const TempFolder folder;
  CityInputs inputs = two_files(folder);
  inputs.maps = {folder / "map.osm"};
  const glm::dvec2 middle(391005, 5819005);
  const City plain(two_files(folder), folder / "scratch");
  const auto use = [&](const std::string& of_ways, const std::string& of_relation) {
    test::write_text(inputs.maps[0], write_relation(plain, of_ways, of_relation));
    const lights::UseAt at = make_use_finder(City(inputs, folder / "scratch"));
    return at ? at(middle) : std::nullopt;
  };
  EXPECT_EQ(use("", tag("building", "retail")), BuildingUse::retail);
  EXPECT_EQ(survey_city(inputs).map_multipolygons.size(), 1u) << "parts of a bake know it too";
  EXPECT_EQ(use("", tag("building", "yes") + tag("amenity", "school")), BuildingUse::education);
  EXPECT_EQ(use(tag("building", "office"), ""), BuildingUse::office)
      << "outer ways say what an untagged relation is";
  EXPECT_FALSE(use("", tag("building", "yes")));
  EXPECT_FALSE(use("", tag("building", "retail") + tag("end_date", "1990")));
  EXPECT_FALSE(use("", tag("landuse", "retail")));
}

}  // namespace
}  // namespace nightcity::bake
