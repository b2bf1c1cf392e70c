// Properties that both readers share.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "formats/error.h"
#include "tests/tools/citygml/read_file.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

using namespace test;

class BothReaders : public testing::TestWithParam<city::Reader> {
 protected:
  City read(const std::string& text, int max_lod = 2) const {
    const TemporaryFile file(text);
    City city;
    city::ReadOptions options;
    options.reader = GetParam();
    options.max_lod = max_lod;
    city.report = read_citygml(file.path(), options, city.sink());
    return city;
  }
};

std::size_t count_of(const city::CityObject& object, city::SurfaceType surface) {
  return static_cast<std::size_t>(
      std::count_if(object.polygons.begin(), object.polygons.end(),
                    [&](const city::Polygon& p) { return p.surface == surface; }));
}

TEST_P(BothReaders, BuildingIsOneObjectWithItsSurfacesAndNothingTwice) {
  const City city = read(city_model(member(building("A")) + member(building("B"))));
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.report.objects, 2u);
  EXPECT_EQ(city.report.polygons, 6u);
  EXPECT_EQ(city.report.version, "2.0");
  EXPECT_EQ(city.report.srs_name, "EPSG:25833");
  const city::CityObject& a = city.objects[0];
  EXPECT_EQ(a.id, "A");
  EXPECT_EQ(a.type, city::ObjectType::building);
  EXPECT_EQ(a.class_name, "Building");
  EXPECT_EQ(a.lod, 2);
  ASSERT_EQ(a.polygons.size(), 3u);
  EXPECT_EQ(count_of(a, city::SurfaceType::wall), 1u);
  EXPECT_EQ(count_of(a, city::SurfaceType::roof), 1u);
  EXPECT_EQ(count_of(a, city::SurfaceType::ground), 1u);
  EXPECT_EQ(city.objects[1].id, "B");
}

TEST_P(BothReaders, RingsComeOpenAndInDouble) {
  const City city = read(city_model(member(
      "<bldg:Building gml:id=\"A\">" +
      boundary("RoofSurface",
               surface_member(polygon("p",
                                      "33395123.125 5819000.0625 1 33395124.125 5819000.0625 1 "
                                      "33395124.125 5819001.0625 1 33395123.125 5819000.0625 1"))) +
      "</bldg:Building>")));
  ASSERT_EQ(city.objects.size(), 1u);
  const city::Ring& ring = city.objects[0].polygons.at(0).exterior;
  ASSERT_EQ(ring.size(), 3u);
  EXPECT_EQ(ring[0], glm::dvec3(33395123.125, 5819000.0625, 1));
  EXPECT_EQ(city.objects[0].polygons[0].id, "p");
}

TEST_P(BothReaders, PartsAndInstallationsFoldIntoTheirBuilding) {
  const std::string part = "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"A1\">" +
                           boundary("WallSurface", surface_member(polygon("w", south_wall))) +
                           "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  const std::string installation =
      "<bldg:outerBuildingInstallation><bldg:BuildingInstallation "
      "gml:id=\"A2\"><bldg:lod2Geometry>" +
      multi_surface(surface_member(polygon("i", square_at_one))) +
      "</bldg:lod2Geometry></bldg:BuildingInstallation></bldg:outerBuildingInstallation>";
  const City city = read(
      city_model(member("<bldg:Building gml:id=\"A\">" + installation +
                        boundary("GroundSurface", surface_member(polygon("g", square_at_zero))) +
                        part + "</bldg:Building>")));
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons.size(), 3u);
}

TEST_P(BothReaders, AttributesAreReadAndSentinelsAreAbsent) {
  const City city = read(city_model(
      member(building("A",
                      "<bldg:class>1000</bldg:class><bldg:function>31001_1010</bldg:function>"
                      "<bldg:usage>Wohnhaus &amp; Laden</bldg:usage>"
                      "<bldg:yearOfConstruction>1924</bldg:yearOfConstruction>"
                      "<bldg:measuredHeight uom=\"m\">12.5</bldg:measuredHeight>"
                      "<bldg:storeysAboveGround>4</bldg:storeysAboveGround>"
                      "<bldg:storeyHeightsAboveGround uom=\"m\">3.5 3 9999 "
                      "3</bldg:storeyHeightsAboveGround>")) +
      member(building("B",
                      "<bldg:measuredHeight uom=\"m\">-9999</bldg:measuredHeight>"
                      "<bldg:storeysAboveGround>9999</bldg:storeysAboveGround>"))));
  ASSERT_EQ(city.objects.size(), 2u);
  const city::CityObject& a = city.objects[0];
  EXPECT_EQ(a.building_class, "1000");
  EXPECT_EQ(a.function, "31001_1010");
  EXPECT_EQ(a.usage, "Wohnhaus & Laden");
  EXPECT_EQ(a.year, "1924");
  EXPECT_EQ(a.measured_height_m, 12.5);
  EXPECT_EQ(a.storeys_above_ground, 4);
  EXPECT_EQ(a.storey_heights_m, (std::vector<double>{3.5, 3, 3}));
  EXPECT_FALSE(city.objects[1].measured_height_m.has_value());
  EXPECT_FALSE(city.objects[1].storeys_above_ground.has_value());
}

TEST_P(BothReaders, HighestLodUpToTheLimitIsTakenAndTheRestCounted) {
  const std::string lod1 = "<bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" +
                           surface_member(polygon("s1", square_at_zero)) +
                           surface_member(polygon("s2", square_at_one)) +
                           "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid>";
  const std::string text = city_model(member(
      "<bldg:Building gml:id=\"A\">" + lod1 +
      boundary("WallSurface", surface_member(polygon("w2", south_wall)), 2) + "</bldg:Building>"));
  const City two = read(text, 2);
  ASSERT_EQ(two.objects.size(), 1u);
  EXPECT_EQ(two.objects[0].lod, 2);
  EXPECT_EQ(two.objects[0].polygons.size(), 1u);
  EXPECT_EQ(two.report.skipped.at("polygon: lod1, another LoD taken"), 2u);
  const City one = read(text, 1);
  EXPECT_EQ(one.objects[0].lod, 1);
  EXPECT_EQ(one.objects[0].polygons.size(), 2u);
  const City zero = read(text, 0);  // nothing that low: the lowest is taken
  EXPECT_EQ(zero.objects[0].lod, 1);
}

TEST_P(BothReaders, HolesComeAlong) {
  const std::string with_hole = "<gml:Polygon gml:id=\"p\"><gml:exterior>" +
                                ring("0 0 1 9 0 1 9 9 1 0 9 1 0 0 1") +
                                "</gml:exterior><gml:interior>" + ring("2 2 1 2 4 1 4 4 1 2 2 1") +
                                "</gml:interior></gml:Polygon>";
  const City city = read(
      city_model(member("<bldg:Building gml:id=\"A\">" +
                        boundary("RoofSurface", surface_member(with_hole)) + "</bldg:Building>")));
  ASSERT_EQ(city.objects.at(0).polygons.size(), 1u);
  ASSERT_EQ(city.objects[0].polygons[0].interiors.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons[0].interiors[0].size(), 3u);
}

TEST_P(BothReaders, TerrainAndRoadsKnowWhatTheyAre) {
  const std::string relief =
      "<dem:ReliefFeature gml:id=\"R\"><dem:lod>2</dem:lod><dem:reliefComponent><dem:TINRelief "
      "gml:id=\"T\"><dem:lod>2</dem:lod>"
      "<dem:tin><gml:TriangulatedSurface><gml:trianglePatches>"
      "<gml:Triangle><gml:exterior>" +
      ring("0 0 0 9 0 0 0 9 0 0 0 0") +
      "</gml:exterior></gml:Triangle>"
      "<gml:Triangle><gml:exterior>" +
      ring("9 0 0 9 9 0 0 9 0 9 0 0") +
      "</gml:exterior></gml:Triangle>"
      "</gml:trianglePatches></gml:TriangulatedSurface></dem:tin></dem:TINRelief></"
      "dem:reliefComponent></"
      "dem:ReliefFeature>";
  const std::string road =
      "<tran:Road gml:id=\"S\"><tran:function>1</tran:function><tran:lod1MultiSurface>" +
      multi_surface(surface_member(polygon("q", square_at_one))) +
      "</tran:lod1MultiSurface></tran:Road>";
  const City city = read(city_model(member(relief) + member(road)));
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[0].type, city::ObjectType::relief);
  ASSERT_EQ(city.objects[0].polygons.size(), 2u);
  EXPECT_EQ(city.objects[0].polygons[0].surface, city::SurfaceType::terrain);
  EXPECT_EQ(city.objects[1].type, city::ObjectType::road);
  EXPECT_EQ(city.objects[1].function, "1");
  EXPECT_EQ(city.objects[1].polygons.size(), 1u);
}

TEST_P(BothReaders, UnknownMemberIsCountedAndTheNextIsRead) {
  const City city = read(
      city_model(member(building("A")) +
                 member("<urf:UseDistrict xmlns:urf=\"u\" gml:id=\"U\"><urf:lod1MultiSurface>" +
                        multi_surface(surface_member(polygon("z", square_at_one))) +
                        "</urf:lod1MultiSurface></urf:UseDistrict>") +
                 member(building("B"))));
  std::vector<std::string> ids;
  for (const city::CityObject& o : city.objects)
    if (o.type == city::ObjectType::building) ids.push_back(o.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"A", "B"}));
}

TEST_P(BothReaders, CommentInsideCoordinatesLosesNothing) {
  const City city = read(city_model(
      member("<bldg:Building gml:id=\"A\">" +
             boundary("RoofSurface",
                      surface_member(polygon("p", "0 0 1 <!-- note --> 1 0 1 1 1 1 0 0 1"))) +
             "</bldg:Building>")));
  ASSERT_EQ(city.objects.at(0).polygons.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons[0].exterior.size(), 3u);
}

TEST_P(BothReaders, HugeRingIsReadWholeOrCounted) {
  std::string coordinates;
  constexpr int n = 60000;
  for (int i = 0; i <= n; ++i) {
    const double a = 2 * 3.14159265358979 * (i % n) / n;
    coordinates += std::to_string(33395000 + 100 * std::cos(a)) + " " +
                   std::to_string(5819000 + 100 * std::sin(a)) + " 1 ";
  }
  const City city =
      read(city_model(member("<bldg:Building gml:id=\"A\">" +
                             boundary("RoofSurface", surface_member(polygon("p", coordinates))) +
                             "</bldg:Building>") +
                      member(building("B"))));
  EXPECT_EQ(city.objects.back().id, "B");
  if (city.objects.size() == 2) {
    EXPECT_EQ(city.objects[0].polygons.at(0).exterior.size(), static_cast<std::size_t>(n));
  } else {
    EXPECT_EQ(city.report.skipped.at("polygon: in a member libcitygml cannot read"), 1u);
  }
}

TEST_P(BothReaders, DoctypeIsRefusedWithItsLine) {
  const std::string text =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE x [<!ENTITY a SYSTEM \"file:///etc/hostname\">]>\n" +
      city_model(member(building("A"))).substr(39);
  try {
    read(text);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(":2: "), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("DOCTYPE"), std::string::npos) << e.what();
  }
}

TEST_P(BothReaders, WhatIsNotCityGmlIsAnError) {
  for (const std::string text : {"", "   ", "hello", "<a>", "<html></html>", "<a",
                                 "\x7f"
                                 "ELF\0\0",
                                 "\xff\xfe<\0a\0", "<core:CityModel>",
                                 "<core:CityModel><cityObjectMember></core:CityModel>"})
    EXPECT_THROW(read(text), Error) << text;
  city::ReadOptions options;
  options.reader = GetParam();
  EXPECT_THROW(read_citygml("/nowhere/at/all.gml", options, [](city::CityObject&&) {}), Error);
  EXPECT_THROW(
      read_citygml(std::filesystem::temp_directory_path(), options, [](city::CityObject&&) {}),
      Error);
}

TEST_P(BothReaders, FileCutOffAnywhereIsAnErrorNeverASmallerCity) {
  const std::string text = city_model(member(building("A")) + member(building("B")));
  for (std::size_t size = 1; size + 18 < text.size(); size += 97)
    EXPECT_THROW(read(text.substr(0, size)), Error) << size;
}

TEST_P(BothReaders, EmptyCityIsACityWithoutObjects) {
  const City city = read(city_model(""));
  EXPECT_TRUE(city.objects.empty());
  EXPECT_EQ(city.report.polygons, 0u);
  EXPECT_TRUE(read("<CityModel xmlns=\"http://www.opengis.net/citygml/1.0\"/>").objects.empty());
}

std::string name_of_reader(const testing::TestParamInfo<city::Reader>& info) {
  return info.param == city::Reader::libcitygml ? "libcitygml" : "stream";
}
INSTANTIATE_TEST_SUITE_P(CityGml, BothReaders,
                         testing::Values(city::Reader::stream, city::Reader::libcitygml),
                         name_of_reader);

}  // namespace
}  // namespace nightcity::citygml
