// Wavefront OBJ files with known content.
#include "tools/obj/read_obj.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "support/make_png.h"
#include "support/temp_folder.h"
#include "tests/tools/obj/read_text.h"
#include "tools/mesh/triangulate.h"
#include "tools/obj/object_kinds.h"

namespace nightcity::obj {
namespace {

using namespace test;

const char* const corpus = NIGHTCITY_SOURCE_DIR "/tests/tools/obj/corpus/";

double area(const city::CityObject& object) {
  mesh::MeshReport report;
  const mesh::TriangleMesh mesh = mesh::triangulate(object, report);
  double sum = 0;
  for (const mesh::MeshTriangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.vertex[0]], b = mesh.positions[t.vertex[1]],
                     c = mesh.positions[t.vertex[2]];
    sum += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  return sum;
}

city::ReadOptions with_up(city::MeshPlacement::Up up) {
  city::ReadOptions options;
  options.mesh.up = up;
  return options;
}

TEST(Obj, ACubeHasItsSurfaceWhateverFormItsFacesHave) {
  const City city = read_obj_file(std::string(corpus) + "cube.obj");
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[0].id, "house");
  EXPECT_EQ(city.objects[0].type, city::ObjectType::building);
  EXPECT_EQ(city.objects[0].polygons.size(), 6u);
  EXPECT_NEAR(area(city.objects[0]), 6 * 4, 1e-9);
  EXPECT_EQ(city.objects[1].type, city::ObjectType::relief);
  EXPECT_EQ(city.report.assumed.at("kind of an object, by its name: relief"), 1u);
  EXPECT_NEAR(area(city.objects[1]), 18 * 18 / 2, 1e-9);
  EXPECT_EQ(city.report.skipped.at("line (l)"), 1u);
  EXPECT_EQ(city.report.skipped.at("point (p)"), 1u);
  EXPECT_EQ(city.report.skipped.at("colour of a vertex"), 1u);
  EXPECT_EQ(city.report.polygons, 7u);
}

TEST(Obj, TheOldSpellingOfAFaceIsRead) {
  const City city =
      read_obj_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nfo 1 2 3\n", with_up(city::MeshPlacement::Up::z));
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons.size(), 1u);
}

TEST(Obj, UnitAxesAndPlaceComeFromTheOptions) {
  const std::string text = "o a\nv 100 200 -300\nv 200 200 -300\nv 200 200 -400\nf 1 2 3\no b\n";
  city::ReadOptions options = with_up(city::MeshPlacement::Up::y);
  options.mesh.unit_m = 0.01;
  options.mesh.origin = {391000, 5819000, 35};
  City city = read_obj_text(text, options);
  const city::Ring& ring = city.objects.at(0).polygons.at(0).exterior;
  EXPECT_EQ(ring[0], glm::dvec3(391001, 5819003, 37)) << "x east, -z north, y up";
  EXPECT_EQ(ring[2], glm::dvec3(391002, 5819004, 37));
  EXPECT_TRUE(city.report.warnings.empty()) << "nothing is guessed";
  options.mesh.up = city::MeshPlacement::Up::z;
  city = read_obj_text(text, options);
  EXPECT_EQ(city.objects.at(0).polygons.at(0).exterior[0], glm::dvec3(391001, 5819002, 32));
  EXPECT_EQ(read_obj_head(TemporaryFile(text, ".obj").path(), options).sample.size(), 3u);
  EXPECT_EQ(read_obj_head(TemporaryFile(text, ".obj").path(), options).srs_name, "");
}

TEST(Obj, ItsSizeAndTheUnitOfACommentAreTold) {
  const std::string triangle = "v 0 0 0\nv 9000 9000 1000\nv 0 9000 1000\nf 1 2 3\n";
  const auto told = [&](const std::string& start) {
    return read_obj_text(start + triangle, with_up(city::MeshPlacement::Up::z))
        .report.warnings.at(0);
  };
  EXPECT_NE(told("").find("9000 m wide, 9000 m long and 1000 m high"), std::string::npos)
      << told("");
  EXPECT_EQ(told("").find("comment"), std::string::npos);
  EXPECT_EQ(told("# File units = meters\n").find("comment"), std::string::npos);
  EXPECT_NE(told("# File units = inches\n").find("obj_unit_m = 0.0254"), std::string::npos);
  EXPECT_NE(told("# by X\r\n#Units: mm\r\n").find("obj_unit_m = 0.001"), std::string::npos);
}

TEST(Obj, TheAxisAlongWhichACityExtendsLessPointsUp) {
  const City y = read_obj_text("v 0 0 0\nv 9 1 9\nv 0 1 9\nf 1 2 3\n");
  EXPECT_EQ(y.objects.at(0).polygons.at(0).exterior[1], glm::dvec3(9, -9, 1));
  const City z = read_obj_text("v 0 0 0\nv 9 9 1\nv 0 9 1\nf 1 2 3\n");
  EXPECT_EQ(z.objects.at(0).polygons.at(0).exterior[1], glm::dvec3(9, 9, 1));
  EXPECT_NE(z.report.warnings.at(0).find("obj_up"), std::string::npos);
}

TEST(Obj, GroupsArePartsWhereObjectsAreNot) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  const City groups =
      read_obj_text(vertices + "o city\ng a\nf 1 2 3\ng b\nf 1 2 3\ng b\nf 3 2 1\n");
  ASSERT_EQ(groups.objects.size(), 2u);
  EXPECT_EQ(groups.objects[0].id, "a");
  EXPECT_EQ(groups.objects[1].id, "b");
  const City objects = read_obj_text(vertices + "o a\ng x\nf 1 2 3\ng y\nf 3 2 1\no b\nf 1 2 3\n");
  ASSERT_EQ(objects.objects.size(), 2u);
  EXPECT_EQ(objects.objects[0].id, "a");
}

TEST(Obj, WithoutNamesFacesThatHangTogetherAreOneBuilding) {
  // Two squares of two triangles each; the second repeats its vertices, as many programs do.
  const City city = read_obj_text(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"
      "v 5 0 0\nv 6 0 0\nv 6 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 1 0\nv 5 1 0\nf -3 -2 -1\n");
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[0].polygons.size(), 2u);
  EXPECT_EQ(city.objects[1].polygons.size(), 2u);
}

TEST(Obj, AFileOfOneObjectKeepsItsName) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_EQ(read_obj_text(vertices + "o house 7\nf 1 2 3\n").objects.at(0).id, "house 7");
  EXPECT_EQ(read_obj_text(vertices + "g house 8\nf 1 2 3\n").objects.at(0).id, "house 8");
  EXPECT_EQ(read_obj_text("o house 9\ng walls\n" + vertices + "f 1 2 3\n").objects.at(0).id,
            "house 9");
  EXPECT_EQ(read_obj_text(vertices + "o Terrain\nf 1 2 3\n").objects.at(0).type,
            city::ObjectType::relief);
}

TEST(Obj, PartsWithoutNamesAreKnownByTheirShapeInEveryFile) {
  const std::string a = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n",
                    b = "v 5 0 0\nv 6 0 0\nv 6 1 0\nf -3 -2 -1\n";
  const auto ids = [](const std::string& text) {
    std::vector<std::string> names;
    for (const city::CityObject& object :
         read_obj_text(text, with_up(city::MeshPlacement::Up::z)).objects)
      names.push_back(object.id);
    return names;
  };
  const auto both = ids(a + b), turned = ids(b + a);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NE(both[0], both[1]);
  EXPECT_EQ(turned, (std::vector<std::string>{both[1], both[0]}));
  EXPECT_EQ(ids(b), (std::vector<std::string>{both[1]})) << "a tile that holds the second alone";
}

TEST(Obj, LineEndsAndContinuationsDoNotMatter) {
  const std::string plain = "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\no b\nf 3 2 1\n";
  for (const std::string end : {"\r\n", "\r"}) {
    std::string text = plain;
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
      text.replace(at, 1, end);
    EXPECT_EQ(read_obj_text(text).objects.size(), 2u);
  }
  EXPECT_EQ(read_obj_text("# from C:\\city\\\n" + plain).objects.size(), 2u);
  EXPECT_EQ(read_obj_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf \\\n1 \\\r\n2 3").report.polygons, 1u);
  EXPECT_EQ(read_obj_text("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3 # last").report.polygons,
            1u);
}

TEST(Obj, PolygonsOfManyCornersAreTriangulatedAsTheyAre) {
  // An L of area 3; a fan from its first corner would cover 4.
  const City city =
      read_obj_text("v 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5 6\n");
  EXPECT_NEAR(area(city.objects.at(0)), 3, 1e-12);
}

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
  // What hangs together is not one object where the materials are of two kinds.
  EXPECT_EQ(types_of("usemtl Terrain\nf 1 2 3\nusemtl Building\nf 3 4 5 6\nusemtl Terrain\n"
                     "f 1 3 4\n"),
            "building relief ");
}

TEST(Obj, AFileThatBreaksItsFirstLineIsRecognised) {
  EXPECT_TRUE(begins_as_obj("v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_TRUE(begins_as_obj("v 0 \\\r\n0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n"));
  EXPECT_FALSE(begins_as_obj("v 0 0 0 \\\nx\ny z\n"));
}

TEST(Obj, VerticesWithoutFacesAreTold) {
  const auto is_told = [](const std::string& faces) {
    const City city = read_obj_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + faces);
    return std::any_of(city.report.warnings.begin(), city.report.warnings.end(),
                       [](const std::string& w) { return w.find("no faces") != w.npos; });
  };
  EXPECT_TRUE(is_told(""));
  EXPECT_TRUE(is_told("p 1 2 3\n"));
  EXPECT_FALSE(is_told("f 1 2 3\n"));
}

TEST(Obj, AFileIsRecognisedByItsStatements) {
  EXPECT_TRUE(begins_as_obj("# Blender\nmtllib a.mtl\no Cube\n"));
  EXPECT_TRUE(begins_as_obj("v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\n"));
  EXPECT_TRUE(begins_as_obj("g a\nv 1 2 3\nf 1 1 1\n"));
  for (const char* text : {"", "#", "vertices 3\n", "{\"v\": 1}", "<v/>", "v x\n", "f 1 2 3\n",
                           "IESNA:LM-63-2002\n", "g\n"})
    EXPECT_FALSE(begins_as_obj(text)) << text;
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
