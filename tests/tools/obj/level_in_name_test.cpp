// Levels of detail that the names of OBJ files state.
#include "tools/obj/level_in_name.h"

#include <gtest/gtest.h>

#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tests/tools/obj/read_text.h"

namespace nightcity::obj {
namespace {

using namespace test;

TEST(LevelInName, IsReadAsWritersStateIt) {
  struct Case {
    const char* name;
    int level;  // -1: none
  };
  for (const Case& c :
       {Case{"10-304-568-LoD22-3D.obj", 22}, Case{"10-304-568-LoD12-3D.obj", 12},
        Case{"city-LOD2.obj", 20}, Case{"lod1/city.obj.gz", 10}, Case{"city_lod2.2.obj", 22},
        Case{"LoD 3.OBJ", 30}, Case{"LoD2_33_391_5820.obj", 20},  // a tile
        Case{"lod100.obj", -1}, Case{"explod2.obj", -1}, Case{"lod5.obj", -1}, Case{"city.obj", -1},
        Case{"city_lod2.gml", -1}}) {
    const auto found = find_level_in_name(c.name);
    EXPECT_EQ(found ? found->level : -1, c.level) << c.name;
  }
}

TEST(LevelInName, OfFilesThatDifferInItAloneTheBestIsRead) {
  const std::vector<std::string> names{"a-LoD12-3D.obj", "a-LoD13-3D.obj", "a-LoD22-3D.obj",
                                       "b-LoD12-3D.obj", "LoD2_1.obj",     "LoD2_2.obj",
                                       "a.obj",          "a-LoD22-3D.gml"};
  const auto read = [&](int max_lod) {
    std::string out;
    for (const bool one : find_best_levels(names, max_lod)) out += one ? '1' : '0';
    return out;
  };
  EXPECT_EQ(read(2), "00111111");
  EXPECT_EQ(read(1), "01011111");
  EXPECT_EQ(read(0), "10011111");  // all are above: the lowest
}

TEST(LevelInName, AnArchiveOfThreeLevelsIsOneCity) {
  const auto house = [](const std::string& height) {
    return "o house\nv 0 0 0\nv 9 0 0\nv 9 0 " + height + "\nf 1 2 3\n";
  };
  const TempFolder folder;
  pack_zip(folder / "tile.zip", {{"t-LoD12-3D.obj", house("6")},
                                 {"t-LoD13-3D.obj", house("7")},
                                 {"t-LoD22-3D.obj", house("8")}});
  city::ReadOptions z_up;
  z_up.mesh.up = city::MeshPlacement::Up::z;
  const City city = read_obj_file(folder / "tile.zip", z_up);
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons.at(0).exterior[2].z, 8);
  EXPECT_EQ(city.report.passed_over.at("Wavefront OBJ in a lower level of detail"), 2u);
}

}  // namespace
}  // namespace nightcity::obj
