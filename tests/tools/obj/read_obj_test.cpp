// Wavefront OBJ files with known content.
#include "tools/obj/read_obj.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "support/temp_folder.h"
#include "tests/tools/obj/read_text.h"
#include "tools/mesh/triangulate.h"

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

}  // namespace
}  // namespace nightcity::obj
