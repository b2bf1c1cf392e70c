// Hostile input: both readers throw Error or skip and count, and neither crash nor run endlessly.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "formats/error.h"
#include "tests/tools/citygml/read_file.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

using namespace test;

class Hostile : public testing::TestWithParam<city::Reader> {
 protected:
  // Returns the number of polygons delivered, -1 for an Error. Any other exception fails the test.
  static long read(const std::string& text) {
    const TemporaryFile file(text);
    city::ReadOptions options;
    options.reader = GetParam();
    options.threads = 1;
    try {
      long polygons = 0;
      read_citygml(file.path(), options, [&](city::CityObject&& o) {
        for (const city::Polygon& p : o.polygons) {
          ++polygons;
          EXPECT_GE(p.exterior.size(), 3u);
          for (const glm::dvec3& v : p.exterior) EXPECT_TRUE(std::isfinite(v.x + v.y + v.z));
        }
      });
      return polygons;
    } catch (const Error& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      return -1;
    }
  }
};

TEST_P(Hostile, EntityBombIsRefusedBeforeItGrows) {
  std::string text = "<?xml version=\"1.0\"?><!DOCTYPE b [<!ENTITY a \"aaaaaaaaaa\">";
  for (char c = 'b'; c < 'm'; ++c) {
    text += std::string("<!ENTITY ") + c + " \"";
    for (int i = 0; i < 10; ++i) text += std::string("&") + static_cast<char>(c - 1) + ";";
    text += "\">";
  }
  EXPECT_EQ(read(text + "]><CityModel>&l;</CityModel>"), -1);
}

TEST_P(Hostile, DoctypeAnywhereIsRefused) {
  EXPECT_EQ(read("<!DOCTYPE a SYSTEM \"file:///etc/passwd\"><CityModel/>"), -1);
  EXPECT_EQ(read(city_model("<!DOCTYPE a>")), -1);
}

TEST_P(Hostile, UnknownEntityNeverReadsAnything) {
  EXPECT_NE(read(city_model(
                member(building("A", "<bldg:function>&xxe;&#0;&#99999999;&;</bldg:function>")))),
            0);
}

TEST_P(Hostile, DeepNestingIsRefusedOrSkipped) {
  const auto nested = [](const std::string& open, const std::string& inner,
                         const std::string& close) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += open;
    text += inner;
    for (int i = 0; i < 100000; ++i) text += close;
    return text;
  };
  const std::string surfaces =
      nested("<gml:surfaceMember><gml:CompositeSurface>", polygon("p", square_at_one),
             "</gml:CompositeSurface></gml:surfaceMember>");
  const std::string parts =
      nested("<bldg:consistsOfBuildingPart><bldg:BuildingPart>",
             boundary("RoofSurface", surface_member(polygon("p", square_at_one))),
             "</bldg:BuildingPart></bldg:consistsOfBuildingPart>");
  const std::string appearances = nested("<app:Appearance><app:surfaceDataMember>", "",
                                         "</app:surfaceDataMember></app:Appearance>");
  const std::string groups = nested("<grp:CityObjectGroup><grp:groupMember>", building("A"),
                                    "</grp:groupMember></grp:CityObjectGroup>");
  const std::string unknown = nested("<a>", polygon("p", square_at_one), "</a>");
  const std::string points =
      nested("<gml:MultiPoint>", "<gml:pos>1 2 3</gml:pos>", "</gml:MultiPoint>");
  const auto in_building = [](const std::string& inner) {
    return city_model(member("<bldg:Building>" + inner + "</bldg:Building>"));
  };
  EXPECT_LE(read(in_building("<bldg:lod2MultiSurface>" + surfaces + "</bldg:lod2MultiSurface>")),
            0);
  EXPECT_LE(read(in_building(parts)), 0);
  EXPECT_LE(read(in_building("<bldg:appearance>" + appearances + "</bldg:appearance>")), 0);
  EXPECT_LE(read(city_model("<app:appearanceMember>" + appearances + "</app:appearanceMember>")),
            0);
  EXPECT_LE(read(city_model(member(groups))), 0);
  EXPECT_LE(read(in_building(unknown)), 0);
  EXPECT_LE(read(city_model(member(unknown))), 0);
  EXPECT_LE(read(city_model(member("<dem:MassPointRelief><dem:reliefPoints>" + points +
                                   "</dem:reliefPoints></dem:MassPointRelief>"))),
            0);
}

TEST_P(Hostile, BadNumbersNeverBecomeVertices) {
  for (const char* list :
       {"0 0 NaN 1 0 0 1 1 0 0 0 0", "0 0 Inf 1 0 0 1 1 0", "0 0 -inf 1 0 0 1 1 0 0 0 0",
        "1e999 0 0 1 0 0 1 1 0 0 0 0", "0,5 0 0 1,5 0 0 1 1 0", "abc", "0x10 0 0 1 0 0 1 1 0",
        "1 2", "", " ", "0 0 0 1 0 0 1 1 0 \x01", "- - - - - - - - -"})
    EXPECT_LE(read(city_model(member("<bldg:Building gml:id=\"A\">" +
                                     boundary("RoofSurface", surface_member(polygon("p", list))) +
                                     "</bldg:Building>"))),
              0)
        << list;
}

TEST_P(Hostile, MisplacedElementsDoNoHarm) {
  for (const std::string& inner :
       {std::string("<gml:Polygon/>"), std::string("<gml:Polygon><gml:exterior/></gml:Polygon>"),
        std::string("<gml:Polygon>text</gml:Polygon>"), std::string("<gml:Solid/>"),
        std::string("<gml:OrientableSurface orientation=\"-\"/>"),
        polygon("p", "0 0 0") + polygon("p", "0 0 0"), std::string("<core:ImplicitGeometry/>"),
        std::string("<core:ImplicitGeometry><core:transformationMatrix>1 "
                    "2</core:transformationMatrix></core:ImplicitGeometry>"),
        xlink_member(""), xlink_member("#"), std::string("<gml:surfaceMember xlink:href=\"\"/>"),
        std::string("<gml:surfaceMember xlink:href=\"http://a/b#c\"/>"),
        std::string("<bldg:Building/>"), std::string("<core:cityObjectMember/>"),
        std::string("<:/>")})
    read(city_model(member("<bldg:Building gml:id=\"A\"><bldg:lod2MultiSurface>" + inner +
                           "</bldg:lod2MultiSurface></bldg:Building>") +
                    member(inner) + inner));
}

TEST_P(Hostile, FileCutAtAnyByteIsAnError) {
  const std::string text = city_model(member(building("A")));
  const std::size_t end = text.rfind('>');
  const std::size_t step = GetParam() == city::Reader::stream ? 1 : 37;
  for (std::size_t size = 0; size < end; size += step)
    ASSERT_EQ(read(text.substr(0, size)), -1) << size;
}

TEST_P(Hostile, FlippedBytesNeverCrash) {
  const std::string text =
      city_model(member(building("A", "<bldg:measuredHeight>3</bldg:measuredHeight>")) +
                 member(building("B")));
  std::mt19937 random(3);
  const int rounds = GetParam() == city::Reader::stream ? 3000 : 200;
  for (int round = 0; round < rounds; ++round) {
    std::string broken = text;
    for (int i = 0; i < 1 + round % 5; ++i) {
      const char bytes[] = {'<', '>', '/', '"', '&', '\0', '#', ' ', '9', 'z', '\xff', '!', '-'};
      broken[random() % broken.size()] = bytes[random() % sizeof bytes];
    }
    read(broken);
  }
}

TEST_P(Hostile, ShuffledElementsNeverCrash) {
  const std::string text = city_model(member(building("A")) + member(building("B")));
  std::mt19937 random(5);
  const int rounds = GetParam() == city::Reader::stream ? 1000 : 100;
  for (int round = 0; round < rounds; ++round) {
    std::string broken = text;
    const std::size_t from = random() % broken.size(), length = random() % 200,
                      to = random() % broken.size();
    broken.insert(to, text.substr(from, length));
    read(broken);
  }
}

INSTANTIATE_TEST_SUITE_P(CityGml, Hostile,
                         testing::Values(city::Reader::stream, city::Reader::libcitygml),
                         name_reader);

}  // namespace
}  // namespace nightcity::citygml
