#include "tools/citygml/picture_plan.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "support/make_png.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/memory_document.h"
#include "tests/tools/citygml/read_file.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

using namespace test;
using Fate = PicturePlan::Fate;

std::string name_picture(const std::string& uri) {
  return "<app:imageURI>" + uri + "</app:imageURI>";
}

class PicturePlanTest : public ::testing::Test {
 protected:
  void SetUp() override {
    // As large as they say, but of one row: they are not unpacked.
    const std::string large =
        make_png(8192, 8000, std::string("\1\0\0\0\0", 5), '\0' + std::string(1024, '\xff'));
    write_text(folder / "a.png", large);
    write_text(folder / "b.png", large);
    write_text(folder / "red.png", make_rgb_png(2, 2, [](std::size_t, std::size_t) {
                 return std::array<unsigned char, 3>{255, 0, 0};
               }));
  }
  PicturePlan plan(const std::string& text, bool latin1 = false) {
    city::Document document = memory_document(text);
    document.name = (folder / "city.gml").string();
    return PicturePlan(document, latin1);
  }

  const TempFolder folder;
};

TEST_F(PicturePlanTest, APictureThatComesAgainAtOnceCountsOnce) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += name_picture("a.png");
  EXPECT_EQ(plan(text).find_fate(folder / "a.png"), Fate::unpacked);
}

// Two pictures of which only one is remembered are unpacked each time that they come again.
TEST_F(PicturePlanTest, PicturesInTurnsAreBeyondTheBudgetAndOthersAreNot) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += name_picture("a.png") + name_picture("b.png");
  const PicturePlan turns = plan(text + name_picture("red.png"));
  EXPECT_EQ(turns.find_fate(folder / "a.png"), Fate::beyond_budget);
  EXPECT_EQ(turns.find_fate(folder / "b.png"), Fate::beyond_budget);
  EXPECT_EQ(turns.find_fate(folder / "red.png"), Fate::unpacked);
}

TEST_F(PicturePlanTest, SeesNamesHoweverTheyAreWritten) {
  for (const char* written :
       {"<imageURI>red.png</imageURI>", "<app:imageURI >\n  red.png </app:imageURI>",
        "<app:imageURI>./r&#101;d.png</app:imageURI>",
        "<app:imageURI><![CDATA[red.png]]></app:imageURI>"}) {
    const std::string file =
        std::string(written).find("./") != std::string::npos ? "./red.png" : "red.png";
    EXPECT_EQ(plan(written).find_fate(folder / file), Fate::unpacked) << written;
  }
  EXPECT_EQ(plan("<app:imageURI>r\xE9"
                 "d.png</app:imageURI>",
                 true)
                .find_fate(folder / "réd.png"),
            Fate::unpacked);
  for (const char* none :
       {"", "imageURI", "<app:imageURI", "<app:imageURI>red.png",
        "</app:imageURI>red.png</app:imageURI>", "<imageURIs>red.png</imageURIs>"})
    EXPECT_EQ(plan(none).find_fate(folder / "red.png"), Fate::unseen) << none;
}

// A document is looked at in blocks of 512 kB.
TEST_F(PicturePlanTest, SeesNamesAcrossBlocks) {
  for (std::size_t before = (1 << 19) - 40; before < (1 << 19) + 3; ++before)
    for (const std::size_t behind : {0, 100'000}) {
      const std::string text =
          std::string(before, ' ') + name_picture("red.png") + std::string(behind, ' ');
      ASSERT_EQ(plan(text).find_fate(folder / "red.png"), Fate::unpacked) << before;
    }
}

TEST_F(PicturePlanTest, TheReaderLeavesOutTheSamePicturesForAnyNumberOfThreads) {
  const auto texture = [](const std::string& uri, const std::string& target) {
    return "<app:appearance><app:Appearance><app:surfaceDataMember><app:ParameterizedTexture>" +
           name_picture(uri) + "<app:target uri=\"#" + target +
           "\"><app:TexCoordList><app:textureCoordinates ring=\"#r\">0 0 1 0 1 1 0 0"
           "</app:textureCoordinates></app:TexCoordList></app:target>"
           "</app:ParameterizedTexture></app:surfaceDataMember></app:Appearance></app:appearance>";
  };
  std::string members;
  for (int i = 0; i < 60; ++i) {
    const std::string id = "B" + std::to_string(i);
    members += member(building(id, texture(i % 3 == 0   ? "a.png"
                                           : i % 3 == 1 ? "b.png"
                                                        : "red.png",
                                           id + "_r")));
  }
  write_text(folder / "city.gml", city_model(members));
  for (const unsigned threads : {1u, 4u}) {
    city::ReadOptions options;
    options.textures = city::Textures::mean;
    options.threads = threads;
    const City city = read_file(folder / "city.gml", options);
    std::size_t red = 0;
    for (const city::CityObject& object : city.objects)
      for (const city::Polygon& polygon : object.polygons)
        red += polygon.diffuse_colour == glm::vec3(1, 0, 0);
    EXPECT_EQ(red, 20u) << threads;
    EXPECT_EQ(
        city.report.skipped.at("texture: its picture is not unpacked: the textures of one file "
                               "may have 268 million pixels and 64 more for each of their "
                               "bytes; make them smaller"),
        40u)
        << threads;
  }
}

}  // namespace
}  // namespace nightcity::citygml
