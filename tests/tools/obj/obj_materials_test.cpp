// Colours, pictures and kinds of surfaces, from the materials and names of a Wavefront OBJ.
#include <gtest/gtest.h>

#include <array>

#include "support/make_png.h"
#include "support/temp_folder.h"
#include "tests/tools/obj/read_text.h"
#include "tools/obj/object_kinds.h"
#include "tools/obj/read_obj.h"

namespace nightcity::obj {
namespace {

using namespace test;

TEST(Obj, ColoursComeFromTheLibraryBesideTheFile) {
  const TempFolder folder;
  write_text(folder / "my city.mtl",
             "newmtl brick\nKd 0.5 0.25 0\nnewmtl glass\nKd 1.5\nmap_Kd a.png\n");
  write_text(folder / "a.obj",
             "mtllib my city.mtl\nmtllib ../b.mtl /etc/passwd\nv 0 0 0\nv 1 0 0\nv 1 1 0\n"
             "usemtl brick\nf 1 2 3\nusemtl glass\nf 3 2 1\nusemtl none\nf 2 3 1\n");
  const City city = read_obj_file(folder / "a.obj");
  const auto& polygons = city.objects.at(0).polygons;
  EXPECT_EQ(polygons.at(0).diffuse_colour, glm::vec3(0.5f, 0.25f, 0));
  EXPECT_EQ(city.report.skipped.at("texture (map_Kd) of usemtl"), 1u);
  EXPECT_NE(city.report.warnings.at(0).find("does not lie beside"), std::string::npos)
      << "nothing outside the file's folder is read";
  write_text(folder / "my city.mtl", "newmtl brick\n\nKd red\n");
  try {
    read_obj_file(folder / "a.obj");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("my city.mtl:3:"), std::string::npos) << error.what();
  }
}

TEST(Obj, PicturesLieOnFacesByTheirTexturePlaces) {
  const TempFolder folder;
  using Pixel = std::array<unsigned char, 3>;
  constexpr Pixel left{255, 0, 0}, right{0, 0, 255};
  std::filesystem::create_directories(folder / "maps");
  write_text(folder / "maps/two sides.png",
             make_rgb_png(8, 4, [&](std::size_t x, std::size_t) { return x < 4 ? left : right; }));
  write_text(folder / "a.mtl",
             "newmtl wall\nKd 0.1 0.1 0.1\nmap_Kd -clamp on -s 1 1 1 maps\\two sides.png\n"
             "newmtl moved\nmap_Kd -o 0.5 0 maps/two sides.png\n"
             "newmtl gone\nKd 0.5 0.5 0.5\nmap_Kd ../elsewhere.png\n");
  // Faces of the same size, one behind the other: "a b c d" are their places in the picture.
  std::string text = "mtllib a.mtl\nvt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\no wall\n";
  const std::pair<const char*, std::array<const char*, 4>> faces[] = {
      {"wall", {"/1", "/2", "/3", "/4"}},      {"wall", {"/2/9", "/5/9", "/6/9", "/3/9"}},
      {"moved", {"/-6", "/-5", "/-4", "/-3"}}, {"wall", {"", "", "", ""}},
      {"wall", {"/1", "/2", "/3", "/99"}},     {"gone", {"/1", "/2", "/3", "/4"}}};
  for (std::size_t n = 0; const auto& [material, places] : faces) {
    const std::string y = " " + std::to_string(n++) + " ";
    text +=
        "v 0" + y + "0\nv 4" + y + "0\nv 4" + y + "2\nv 0" + y + "2\nusemtl " + material + "\nf";
    for (int k = 0; k < 4; ++k)
      text += " " + std::to_string(k - 4) + places[static_cast<std::size_t>(k)];
    text += "\n";
  }
  write_text(folder / "a.obj", text + "o other\nv 0 0 0\nf -1 -2 -3\n");
  city::ReadOptions options;
  options.mesh.up = city::MeshPlacement::Up::z;
  options.textures = city::Textures::atlas;
  const City city = read_obj_file(folder / "a.obj", options);
  const auto& polygons = city.objects.at(0).polygons;
  ASSERT_EQ(polygons.size(), 6u);
  const glm::vec3 red(1, 0, 0), blue(0, 0, 1);
  EXPECT_EQ(polygons[0].diffuse_colour, red);
  EXPECT_EQ(polygons[1].diffuse_colour, blue);
  EXPECT_EQ(polygons[2].diffuse_colour, blue);
  EXPECT_EQ(polygons[3].diffuse_colour, glm::vec3(0.1f));
  EXPECT_EQ(polygons[4].diffuse_colour, glm::vec3(0.1f));
  EXPECT_EQ(polygons[5].diffuse_colour, glm::vec3(0.5f));
  ASSERT_TRUE(polygons[1].picture);
  EXPECT_EQ(polygons[1].picture->width, 4);
  EXPECT_EQ(polygons[1].picture->height, 4);
  // Rows run from above: the face's lower left corner is the picture's.
  EXPECT_EQ(polygons[1].picture->places, (std::vector<glm::dvec2>{{0, 4}, {4, 4}, {4, 0}, {0, 0}}));
  EXPECT_FALSE(polygons[3].picture || polygons[4].picture || polygons[5].picture);
  // The material goes on to the other object, whose face has no places either.
  EXPECT_EQ(city.report.skipped.at("texture: a place in its picture that is not there"), 3u);
  EXPECT_EQ(city.report.skipped.at("texture: its picture lies elsewhere"), 1u);
  options.textures = city::Textures::mean;
  const City mean = read_obj_file(folder / "a.obj", options);
  EXPECT_EQ(mean.objects.at(0).polygons[1].diffuse_colour, blue);
  EXPECT_FALSE(mean.objects.at(0).polygons[1].picture);
}

TEST(Obj, NamesSayWhatIsNoBuilding) {
  EXPECT_EQ(find_object_type("Terrain_01"), city::ObjectType::relief);
  EXPECT_EQ(find_object_type("roads.003"), city::ObjectType::road);
  EXPECT_EQ(find_object_type("Broadway Building"), city::ObjectType::building);
  EXPECT_EQ(find_object_type("underground"), city::ObjectType::building);
  EXPECT_EQ(find_object_type(""), city::ObjectType::building);
}

// 3dfier names objects by numbers, and materials by what they are.
TEST(Obj, MaterialsSayWhatIsNoBuildingWhereNamesDoNot) {
  const std::string corners = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 0 9 3\nv 9 9 3\n";
  const auto types_of = [&](const std::string& faces) {
    const City city = read_obj_text(corners + faces, with_up(city::MeshPlacement::Up::z));
    std::string types;
    for (const city::CityObject& object : city.objects) {
      types += name_of(object.type);
      types += ' ';
    }
    return types;
  };
  EXPECT_EQ(types_of("o b31\nusemtl Terrain\nf 1 2 3\no b32\nusemtl Building\nf 3 4 5 6\n"
                     "o b33\nusemtl Water\nf 1 3 4\n"),
            "relief building water ");
  EXPECT_EQ(types_of("o b31\nusemtl Terrain\nf 1 2 3\nusemtl Brick\nf 3 4 5 6\n"), "building ");
  EXPECT_EQ(types_of("o House 4\nusemtl terrain\nf 1 2 3\no x\nf 3 4 5\n"), "building relief ");
  EXPECT_EQ(types_of("o x\nusemtl ground\nf 1 2 3\no y\nusemtl Water pipe\nf 3 4 5\n"),
            "building building ");
  // Faces that hang together are two objects where their materials are of two kinds.
  EXPECT_EQ(types_of("usemtl Terrain\nf 1 2 3\nusemtl Building\nf 3 4 5 6\nusemtl Terrain\n"
                     "f 1 3 4\n"),
            "building relief ");
}

TEST(Obj, PlacesOnAPictureThatAreNoNumbersHideNoFile) {
  EXPECT_TRUE(begins_as_obj("o a\nvt nan -nan\nv 0 0 0\nv 1 0 0\n"));
  EXPECT_FALSE(begins_as_obj("v as in vertex\n"));
  const City city = read_obj_text("vt nan nan\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1/1 2/1 3/1\n",
                                  with_up(city::MeshPlacement::Up::z));
  EXPECT_EQ(city.report.polygons, 1u);
}

}  // namespace
}  // namespace nightcity::obj
