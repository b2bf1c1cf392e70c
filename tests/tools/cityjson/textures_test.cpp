// Textures of CityJSON: pictures beside the file, and places in them by number.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "support/make_png.h"
#include "support/temp_folder.h"
#include "tests/tools/cityjson/read_text.h"
#include "tests/tools/cityjson/small_cityjson.h"

namespace nightcity::cityjson {
namespace {

using namespace test;

// A cube whose faces have these textures, in a folder with a picture of two pixels: black, white.
class CityJsonTextures : public testing::Test {
 protected:
  CityJsonTextures() {
    write_text(folder / "two.png", make_rgb_png(2, 1, [](std::size_t x, std::size_t) {
                 const unsigned char v = x == 0 ? 0 : 255;
                 return std::array<unsigned char, 3>{v, v, v};
               }));
  }
  City read_faces(const std::string& faces, city::Textures textures, bool is_sequence = false) {
    const std::string appearance =
        "\"appearance\":{\"textures\":[{\"type\":\"PNG\",\"image\":\"two.png\"},"
        "{\"type\":\"PNG\",\"image\":\"../two.png\"},{\"type\":\"PNG\",\"image\":\"none.png\"}],"
        "\"vertices-texture\":[[0,0],[0.5,0],[0.5,1],[0,1],[1,0],[1,1],[null,0]],"
        "\"default-theme-texture\":\"day\"}";
    const std::string cube = object(
        "a", "Building",
        solid("\"2\"", "\"texture\":{\"night\":{\"values\":[[[[2]]]]},\"day\":{\"values\":[[" +
                           faces + "]]}}"));
    const std::string text =
        is_sequence ? header() + feature("a", cube, appearance) : city_json(cube, appearance);
    write_text(folder / "city.json", text);
    city::ReadOptions options;
    options.textures = textures;
    City city;
    const city::ObjectSink sink = city.sink();
    city.report = read_cityjson_staged(folder / "city.json", options, city::deliver_to(sink));
    return city;
  }
  const TempFolder folder;
};

TEST_F(CityJsonTextures, GiveTheMeanOfTheirPartAndThePart) {
  for (const bool is_sequence : {false, true})
    for (const city::Textures textures : {city::Textures::mean, city::Textures::atlas}) {
      const City city = read_faces("[[0,0,1,2,3]],[[0,1,4,5,2]],[[null]]", textures, is_sequence);
      const auto& faces = city.objects.at(0).polygons;
      EXPECT_EQ(faces[0].diffuse_colour, glm::vec3(0));
      EXPECT_EQ(faces[1].diffuse_colour, glm::vec3(1));
      EXPECT_FALSE(faces[2].diffuse_colour);
      EXPECT_FALSE(faces[3].diffuse_colour) << "values end before it";
      EXPECT_TRUE(city.report.skipped.empty());
      ASSERT_EQ(faces[1].picture != nullptr, textures == city::Textures::atlas);
      if (!faces[1].picture) continue;
      EXPECT_EQ(faces[1].picture->width, 1);
      EXPECT_EQ(faces[1].picture->rgb, (std::vector<std::uint8_t>{255, 255, 255}));
      EXPECT_EQ(faces[1].picture->places,
                (std::vector<glm::dvec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
    }
}

TEST_F(CityJsonTextures, ThatCannotBeUsedAreCountedByReason) {
  const City city = read_faces(
      "[[1,0,1,2,3]],[[2,0,1,2,3]],[[9,0,1,2,3]],[[0,0,1,2]],[[0,0,1,2,77]],[[0,6,1,2,3]]",
      city::Textures::atlas);
  const auto& skipped = city.report.skipped;
  EXPECT_EQ(skipped.at("texture: its picture lies elsewhere"), 1u);
  EXPECT_EQ(skipped.at("texture: its picture is not there"), 1u);
  EXPECT_EQ(skipped.at("texture: its picture is not in the list"), 1u);
  EXPECT_EQ(
      skipped.at("texture: a ring has another number of texture coordinates than of vertices"), 1u);
  EXPECT_EQ(skipped.at("texture: a place in its picture that is not there"), 1u);
  EXPECT_EQ(skipped.at("texture: its place in the picture is no number, or its object has too many "
                       "pixels"),
            1u);
  for (const city::Polygon& polygon : city.objects.at(0).polygons) EXPECT_FALSE(polygon.picture);
}

}  // namespace
}  // namespace nightcity::cityjson
