// Skins of buildings keep to the table: its bounds, its means, and the same one for the same id.
#include "tools/bake/scene/skins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/bake/bake.h"
#include "tools/bake/scene/skin_buildings.h"
#include "tools/random.h"

namespace nightcity::bake {
namespace {

using namespace test;
using lights::BuildingUse;

constexpr int use_count = static_cast<int>(BuildingUse::dark) + 1,
              age_count = static_cast<int>(Age::count),
              part_count = static_cast<int>(SkinPart::count),
              finish_count = static_cast<int>(Finish::count);

double find_middle(Finish finish) {
  const FinishRow& row = find_finish(finish);
  return (double{row.min_reflectance} + double{row.max_reflectance}) / 2;
}

double find_luminance(const glm::vec3& colour) {
  return 0.2126 * double{colour.x} + 0.7152 * double{colour.y} + 0.0722 * double{colour.z};
}

TEST(Skins, ShadesLieWithinTheBoundsOfTheirFinishAndHaveItsMiddleAsMean) {
  for (int n = 0; n < finish_count; ++n) {
    const auto finish = static_cast<Finish>(n);
    const FinishRow& row = find_finish(finish);
    ASSERT_FALSE(row.tints.empty()) << n;
    double sum = 0;
    for (std::size_t shade = 0; shade < row.tints.size(); ++shade) {
      const float reflectance = find_reflectance({finish, static_cast<std::uint8_t>(shade)});
      EXPECT_GE(reflectance, row.min_reflectance) << row.name;
      EXPECT_LE(reflectance, row.max_reflectance) << row.name;
      sum += double{reflectance};
    }
    EXPECT_NEAR(sum / static_cast<double>(row.tints.size()), find_middle(finish), 1e-6) << row.name;
  }
}

// 135 means are compared. Each is off by more than five standard errors once in 1.7 million times,
// so one of all is in 13,000.
TEST(Skins, TheMeanOverManyIdsIsThatOfTheTableForEachUseAgeAndPart) {
  constexpr int ids = 20'000;
  for (int use = 0; use < use_count; ++use)
    for (int age = 0; age < age_count; ++age) {
      double sum[part_count] = {}, squares[part_count] = {};
      for (int id = 0; id < ids; ++id) {
        const BuildingSkin skin = draw_skin(hash_text("DEBE_" + std::to_string(id)),
                                            static_cast<BuildingUse>(use), static_cast<Age>(age));
        for (int part = 0; part < part_count; ++part) {
          const double reflectance = double{find_reflectance(skin.of(static_cast<SkinPart>(part)))};
          sum[part] += reflectance;
          squares[part] += reflectance * reflectance;
        }
      }
      for (int part = 0; part < part_count; ++part) {
        double mean = 0;
        for (const Finish finish : list_finishes(
                 static_cast<SkinPart>(part), static_cast<BuildingUse>(use), static_cast<Age>(age)))
          mean += find_middle(finish) / finish_choices;
        const double found = sum[part] / ids,
                     variance = std::max(squares[part] / ids - found * found, 0.0);
        EXPECT_NEAR(found, mean, 5 * std::sqrt(variance / ids) + 1e-6)
            << "use " << use << ", age " << age << ", part " << part;
      }
    }
}

TEST(Skins, ARowOfHousesIsNotOfOneGrey) {
  std::map<Skin, int> walls;
  for (int house = 1; house <= 20; ++house)
    ++walls[draw_skin(hash_text("house " + std::to_string(house)), BuildingUse::residential,
                      Age::unknown)
                .of(SkinPart::walls)];
  EXPECT_GE(walls.size(), 3u);
}

TEST(Skins, AnAgeIsAYearBetweenItsBordersAndNonsenseIsUnknown) {
  EXPECT_EQ(find_age("1000"), Age::before_1919);
  EXPECT_EQ(find_age("1918"), Age::before_1919);
  EXPECT_EQ(find_age("1919"), Age::from_1919);
  EXPECT_EQ(find_age("1948"), Age::from_1919);
  EXPECT_EQ(find_age("1949"), Age::from_1949);
  EXPECT_EQ(find_age("1978"), Age::from_1949);
  EXPECT_EQ(find_age("1979"), Age::from_1979);
  EXPECT_EQ(find_age("2100"), Age::from_1979);
  for (const char* nonsense :
       {"", "0", "-1950", "999", "2101", "9999", "99999999999", "C18", "~195", "195x", "nan"})
    EXPECT_EQ(find_age(nonsense), Age::unknown) << nonsense;
}

TEST(Skins, TilesCoverRoofsSteeperThanTenDegrees) {
  const auto find_part = [](double pitch_deg) {
    const double rise = std::tan(glm::radians(pitch_deg));
    TileStore::Triangle roof{{{5e5, 5e6, 9}, {5e5 + 4, 5e6, 9}, {5e5, 5e6 + 1, 9 + rise}},
                             to_code(BakeMaterial::roof),
                             NodeKind::city};
    return find_skin_part(roof);
  };
  EXPECT_EQ(find_part(0), SkinPart::flat_roof);
  EXPECT_EQ(find_part(9.9), SkinPart::flat_roof);
  EXPECT_EQ(find_part(-9.9), SkinPart::flat_roof);
  EXPECT_EQ(find_part(10.1), SkinPart::pitched_roof);
  EXPECT_EQ(find_part(80), SkinPart::pitched_roof);
}

TEST(Materials, AKindIsKnownByItsNameWithAColourOrASkinOrWithout) {
  for (const char* roof : {"roof", "roof #804000", "roof tiles 2"})
    EXPECT_TRUE(is_of_kind(roof, "roof")) << roof;
  for (const char* other : {"", "wall", "roo", "roofing", "wall roof"})
    EXPECT_FALSE(is_of_kind(other, "roof")) << other;
}

std::shared_ptr<PreparedObject> make_building(const std::string& id) {
  const auto building = std::make_shared<PreparedObject>();
  building->object.type = city::ObjectType::building;
  building->object.id = id;
  building->use = BuildingUse::office;
  return building;
}

TEST(BuildingSkinner, PiecesOfABuildingLookLikeItsFirstOne) {
  BuildingSkinner skinner({});
  const auto first = make_building("a"), piece = make_building("a");
  piece->use = BuildingUse::industrial;  // as its own outline says
  const TileStore::Triangle wall{
      {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, to_code(BakeMaterial::wall), NodeKind::city};
  std::vector<TileStore::Triangle> one{wall}, other{wall};
  skinner.apply(skinner.find_skin(*first), first->object, false, one);
  skinner.apply(skinner.find_skin(*piece), piece->object, true, other);
  EXPECT_NE(one[0].material, wall.material);
  EXPECT_EQ(other[0].material, one[0].material);
  EXPECT_EQ(skinner.report().walls.at("table"), 1u);
}

TEST(BuildingSkinner, ColoursOfModelAndMapStayAndAreCounted) {
  BuildingSkinner skinner({});
  const MaterialCode red = to_code(BakeMaterial::wall, glm::vec3(1, 0, 0)),
                     door = to_code(BakeMaterial::door);
  const auto make = [](MaterialCode material) {
    return TileStore::Triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, material, NodeKind::city};
  };
  for (const bool of_map : {false, true}) {
    const auto building = make_building("b");
    building->object.of_map = of_map;
    std::vector<TileStore::Triangle> triangles{make(red), make(door),
                                               make(to_code(BakeMaterial::roof))};
    skinner.apply(skinner.find_skin(*building), building->object, false, triangles);
    EXPECT_EQ(triangles[0].material, red);
    EXPECT_EQ(triangles[1].material, door);
    EXPECT_TRUE(is_of_kind(triangles[2].material, BakeMaterial::roof));
    EXPECT_NE(triangles[2].material, to_code(BakeMaterial::roof));
  }
  using Counts = std::map<std::string, std::size_t>;
  EXPECT_EQ(skinner.report().walls, (Counts{{"model", 1}, {"map", 1}}));
  EXPECT_EQ(skinner.report().roofs, (Counts{{"table", 2}}));
  EXPECT_EQ(skinner.report().ages, (Counts{{"unknown", 2}}));
}

// A wall of 8 m on the ground, `number` places from the south-west.
std::string wall_of(const std::string& id, int number, const std::string& attributes) {
  const std::string west = std::to_string(391000 + 20 * number),
                    east = std::to_string(391008 + 20 * number), south = " 5819000 ";
  const std::string ring = west + south + "0 " + east + south + "0 " + east + south + "9 " + west +
                           south + "9 " + west + south + "0";
  return member("<bldg:Building gml:id=\"" + id + "\">" + attributes +
                boundary("WallSurface", surface_member(polygon("", ring))) + "</bldg:Building>");
}

// Returns the material of each building of a scene, by its id.
std::map<std::string, SceneMaterial> find_walls(const std::filesystem::path& folder) {
  const Scene scene = read_scene(folder / "city.glb");
  std::map<std::string, SceneMaterial> walls;
  for (const SceneNode& node : scene.nodes)
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
      for (const std::uint32_t feature : primitive.feature_ids)
        if (feature != no_id && node.kind == "city")
          walls[scene.features[feature].id] = scene.materials[primitive.material];
  return walls;
}

class SkinnedCity : public testing::Test {
 protected:
  BakeReport bake_city(const std::string& name, const std::string& members) {
    write_text(folder_ / (name + ".gml"), city_model(members));
    recipe_.city.files = {folder_ / (name + ".gml")};
    recipe_.windows.lit = false;
    recipe_.terrain.make_surface = false;
    return bake(recipe_, folder_ / name);
  }
  TempFolder folder_;
  Recipe recipe_;
};

TEST_F(SkinnedCity, AnIdHasOneSkinWhateverStandsBesideItAndInWhichOrder) {
  std::string forth, back;
  for (int n = 0; n < 30; ++n) {
    const std::string house = wall_of("h" + std::to_string(n), n, "");
    forth += house;
    back = house + back;
  }
  bake_city("forth", forth);
  bake_city("back", back);
  bake_city("alone", wall_of("h7", 0, ""));
  const auto there = find_walls(folder_ / "forth"), here = find_walls(folder_ / "back");
  ASSERT_EQ(there.size(), 30u);
  for (const auto& [id, material] : there) {
    EXPECT_EQ(here.at(id).name, material.name) << id;
    EXPECT_EQ(here.at(id).base_colour, material.base_colour) << id;
  }
  EXPECT_EQ(find_walls(folder_ / "alone").at("h7").name, there.at("h7").name);
}

TEST_F(SkinnedCity, UseAndYearDecideTheFinishAndTheWordOfTheRecipeTurnsItOff) {
  const std::string hall =
      "<bldg:function>31001_2112</bldg:function>"
      "<bldg:yearOfConstruction>1900</bldg:yearOfConstruction>";
  std::string members;
  for (int n = 0; n < 20; ++n) members += wall_of("w" + std::to_string(n), n, hall);
  const BakeReport report = bake_city("works", members);
  EXPECT_EQ(report.tiles.skins.walls.at("table"), 20u);
  EXPECT_EQ(report.tiles.skins.ages.at("before 1919"), 20u);
  const FinishRow& brick = find_finish(Finish::brick);
  for (const auto& [id, material] : find_walls(folder_ / "works")) {
    EXPECT_TRUE(material.name.starts_with("wall brick")) << id << ": " << material.name;
    EXPECT_GE(find_luminance(material.base_colour), double{brick.min_reflectance});
    EXPECT_LE(find_luminance(material.base_colour), double{brick.max_reflectance});
  }
  recipe_.city.skins = false;
  EXPECT_TRUE(bake_city("grey", members).tiles.skins.walls.empty());
  for (const auto& [id, material] : find_walls(folder_ / "grey")) EXPECT_EQ(material.name, "wall");
}

}  // namespace
}  // namespace nightcity::bake
