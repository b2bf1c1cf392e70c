// Hostile OBJ files: an Error with file and line, or skipped and counted; never a crash.
#include <gtest/gtest.h>

#include <random>

#include "support/temp_folder.h"
#include "tests/tools/obj/read_text.h"

namespace nightcity::obj {
namespace {

using namespace test;

TEST(HostileObj, BrokenStatementsAreErrorsWithTheirLine) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_NE(error_of_obj("v 0 0\n").find(".obj:1: a vertex"), std::string::npos);
  EXPECT_NE(error_of_obj("\n\nv 0 0 nan\n").find(".obj:3:"), std::string::npos);
  EXPECT_NE(error_of_obj("v 0 0 1e999\n").find(".obj:1:"), std::string::npos);
  EXPECT_NE(error_of_obj("v 0,5 0 0\n").find(".obj:1:"), std::string::npos) << "decimal commas";
  for (const char* face : {"f 1 2 4", "f 0 1 2", "f -4 1 2", "f 1 2 x", "f 1 2 3.5",
                           "f 1 2 99999999999999999999", "f 1 2 /3"})
    EXPECT_NE(error_of_obj(triangle + face).find(".obj:4: a face refers to vertex"),
              std::string::npos)
        << face << ": " << error_of_obj(triangle + face);
  EXPECT_EQ(error_of_obj("f 1 2 3\n" + triangle), "read") << "faces may come before their vertices";
  city::ReadOptions options;
  options.mesh.max_vertices = 2;
  EXPECT_NE(error_of_obj(triangle, options).find("obj_max_vertices = 2"), std::string::npos);
}

TEST(HostileObj, FacesThatAreNoneAreSkippedAndCounted) {
  const City city = read_obj_text(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 1 0\nf 1 2\nf\nf 1 1 1\nf 1 2 2\nf 1 3 4\nf 1 2 3\ncurv 1 "
      "2\n");
  EXPECT_EQ(city.report.polygons, 1u);
  EXPECT_EQ(city.report.skipped.at("polygon: of fewer than three vertices"), 5u);
  EXPECT_EQ(city.report.skipped.at("curve or surface of parameters (curv)"), 1u);
}

// A library that is named again for each object would be read as often.
TEST(HostileObj, LibrariesAreReadOnceAndFacesKeepTheMaterialThatTheyHad) {
  const TempFolder folder;
  write_text(folder / "red.mtl", "newmtl m\nKd 1 0 0\n");
  write_text(folder / "blue.mtl", "newmtl m\nKd 0 0 1\n");
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (const char* library : {"red", "blue", "red"})
    text += std::string("mtllib ") + library + ".mtl\no of " + library + "\nusemtl m\nf 1 2 3\n";
  write_text(folder / "a.obj", text);
  const City city = read_obj_file(folder / "a.obj");
  ASSERT_EQ(city.objects.size(), 3u);
  const glm::vec3 red(1, 0, 0), blue(0, 0, 1);
  EXPECT_EQ(city.objects[0].polygons.at(0).diffuse_colour, red);
  EXPECT_EQ(city.objects[1].polygons.at(0).diffuse_colour, blue);
  EXPECT_EQ(city.objects[2].polygons.at(0).diffuse_colour, blue) << "red.mtl is read already";
}

TEST(HostileObj, AnythingCutOffOrChangedIsReadOrAnError) {
  const std::string text =
      read_text(std::string(NIGHTCITY_SOURCE_DIR) + "/tests/tools/obj/corpus/cube.obj");
  for (std::size_t size = 0; size < text.size(); size += 7) error_of_obj(text.substr(0, size));
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    std::string changed = text;
    for (int n = 0; n < 4; ++n) changed[random() % changed.size()] = static_cast<char>(random());
    error_of_obj(changed);
  }
}

}  // namespace
}  // namespace nightcity::obj
