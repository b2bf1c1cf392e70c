// CityGML as portals and tools write it beyond the examples of the standard: objects that are not
// there, heights under names of their own, links in place of objects, two documents in one file.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "formats/error.h"
#include "tests/tools/citygml/read_file.h"
#include "tools/city/end_date.h"

namespace nightcity::citygml {
namespace {

using namespace test;

std::string water(const std::string& properties) {
  return member("<wtr:WaterBody gml:id=\"w\">" + properties + "<wtr:lod1MultiSurface>" +
                multi_surface(surface_member(polygon("", square_at_one))) +
                "</wtr:lod1MultiSurface></wtr:WaterBody>");
}

City read_water(const std::string& properties) {
  std::string text = city_model(water(properties) + member(building("b")));
  const char* names =
      " xmlns:wtr=\"http://www.opengis.net/citygml/waterbody/2.0\""
      " xmlns:uro=\"https://www.geospatial.jp/iur/uro/3.1\"";
  return read(text.insert(text.find(" xmlns:gml"), names));
}

// Japan publishes the water of floods that may come as water bodies: it would stand over the city.
TEST(CityGmlProducers, WaterOfAFloodThatMayComeIsLeftOutAndCounted) {
  for (const char* properties :
       {"<wtr:class codeSpace=\"../../codelists/WaterBody_class.xml\"> 1140 </wtr:class>",
        "<uro:floodingRiskAttribute><uro:RiverFloodingRiskAttribute><uro:rank>1</uro:rank>"
        "</uro:RiverFloodingRiskAttribute></uro:floodingRiskAttribute>",
        "<uro:WaterBodyTsunamiRiskAttribute/>"}) {
    const City city = read_water(properties);
    ASSERT_EQ(city.objects.size(), 1u) << properties;
    EXPECT_EQ(city.objects[0].id, "b");
    EXPECT_EQ(city.report.skipped.at(city::flood_object), 1u);
    EXPECT_EQ(city.report.skipped.at("polygon: of an object that is not there"), 1u);
  }
  EXPECT_EQ(read_water("<wtr:class>1020</wtr:class>").objects.size(), 2u);
}

// Such attributes of a building say what would happen to it, and class 1140 is another one.
TEST(CityGmlProducers, BuildingsThatAFloodMayReachStand) {
  const City city = read(city_model(
      member(building("b", "<bldg:class>1140</bldg:class><gen:bldgDisasterRiskAttribute/>"))));
  EXPECT_EQ(city.objects.size(), 1u);
}

TEST(CityGmlProducers, WhatIsNotThereYetIsLeftOutAndCounted) {
  const auto read_with = [](const std::string& date) {
    return read(city_model(member(building("a", "<core:validFrom>" + date + "</core:validFrom>")) +
                           member(building("b"))));
  };
  for (const char* date : {"9998", "9998-01-01", "9998-12-31T00:00:00Z"}) {
    const City city = read_with(date);
    ASSERT_EQ(city.objects.size(), 1u) << date;
    EXPECT_EQ(city.objects[0].id, "b");
    EXPECT_EQ(city.report.skipped.at(city::future_object), 1u);
  }
  for (const char* date : {"1998", "2012-05-01", "soon", ""})
    EXPECT_EQ(read_with(date).objects.size(), 2u) << date;
}

TEST(CityGmlProducers, LinksToObjectsOfOtherFilesAreCounted) {
  const City city =
      read(city_model(member(building("b")) + "<core:cityObjectMember xlink:href=\"b.gml#b1\"/>" +
                      "<core:cityObjectMember xlink:href=\"#b\"/><core:cityObjectMember/>"));
  EXPECT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.report.skipped.at("xlink: to an object in another file (b.gml)"), 1u);
}

TEST(CityGmlProducers, ASecondDocumentInOneFileIsRefusedWithItsLine) {
  const std::string one = city_model(member(building("b")));
  const TemporaryFile two(one + one);
  try {
    read_file(two.path());
    FAIL() << "the second document was not seen";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a second <core:CityModel>"), std::string::npos);
    EXPECT_GT(error.line(), 2u);
  }
  for (const char* behind : {"\n<!-- made by hand: <core:CityModel> -->\n", " \n\n", "<?end now?>"})
    EXPECT_EQ(read(one + behind).objects.size(), 1u) << behind;
}

// One page of a server's answer would be a part of the city.
TEST(CityGmlProducers, APageOfAServersAnswerIsToldAsSuch) {
  const auto warnings_of = [](const std::string& attributes, const std::string& more = "") {
    std::string text = city_model(member(building("b")) + more);
    for (std::size_t at = 0; (at = text.find("core:CityModel", at)) != std::string::npos;)
      text.replace(at, 14, "wfs:FeatureCollection");
    text.insert(text.find(" xmlns:gml"),
                " xmlns:wfs=\"http://www.opengis.net/wfs/2.0\" " + attributes);
    const City city = read(text);
    EXPECT_EQ(city.objects.size(), 1u);
    std::string all;
    for (const std::string& warning : city.report.warnings) all += warning + "\n";
    return all;
  };
  EXPECT_NE(warnings_of("numberMatched=\"1000\" numberReturned=\"1\"")
                .find("incomplete: the server gave 1 of 1000 features"),
            std::string::npos);
  EXPECT_NE(warnings_of("numberMatched=\"unknown\" next=\"http://x/?startIndex=1&amp;count=1\"")
                .find("incomplete: the server gave one page"),
            std::string::npos);
  for (const char* element : {"wfs:truncatedResponse", "ows:ExceptionReport"})
    EXPECT_NE(warnings_of("", std::string("<") + element + "/>").find("broke its answer off"),
              std::string::npos);
  EXPECT_EQ(warnings_of("numberMatched=\"1\" numberReturned=\"1\" next=\"\""), "");
}

city::CityObject read_footprint(const std::string& properties) {
  City city = read_member("<bldg:Building gml:id=\"b\">" + properties + "<bldg:lod0FootPrint>" +
                          multi_surface(surface_member(polygon("", square_at_zero))) +
                          "</bldg:lod0FootPrint></bldg:Building>");
  return city.objects.size() == 1 ? city.objects[0] : city::CityObject();
}

// Without a height under the standard's name a footprint would be flat.
TEST(CityGmlProducers, AFootprintIsAsHighAsItsGenericAttributesSay) {
  const auto attribute = [](const char* kind, const char* name, const char* value) {
    return std::string("<gen:") + kind + " name=\"" + name + "\"><gen:value>" + value +
           "</gen:value></gen:" + kind + ">";
  };
  const std::string ground = attribute("stringAttribute", "HoeheGrund", "112,5"),
                    roof = attribute("stringAttribute", "HoeheDach", "121.5");
  for (const std::string& properties :
       {attribute("doubleAttribute", "Height", "9"), attribute("stringAttribute", "height", "9,0"),
        "<gen:genericAttributeSet name=\"s\">" + attribute("doubleAttribute", "bldg_height", "9") +
            "</gen:genericAttributeSet>",
        std::string("<gen:measureAttribute name=\"height\"><gen:value uom=\"cm\">900</gen:value>"
                    "</gen:measureAttribute>"),
        std::string("<core:genericAttribute><gen:DoubleAttribute><gen:name>height</gen:name>"
                    "<gen:value>9</gen:value></gen:DoubleAttribute></core:genericAttribute>"),
        ground + roof, std::string("<bldg:measuredHeight uom=\"m\">9,0</bldg:measuredHeight>"),
        std::string("<bldg:measuredHeight>9 m</bldg:measuredHeight>"),
        std::string("<bldg:measuredHeight>900 cm</bldg:measuredHeight>"),
        "<bldg:measuredHeight uom=\"m\">9</bldg:measuredHeight>" +
            attribute("doubleAttribute", "Height", "40")}) {
    const city::CityObject house = read_footprint(properties);
    ASSERT_TRUE(house.measured_height_m) << properties;
    EXPECT_DOUBLE_EQ(*house.measured_height_m, 9) << properties;
    EXPECT_EQ(house.polygons.size(), 6u);
  }
  for (const std::string& properties :
       {ground, roof, attribute("doubleAttribute", "Height", "-9999"),
        attribute("doubleAttribute", "RoofHeightClass", "9")})
    EXPECT_EQ(read_footprint(properties).polygons.size(), 1u) << properties;
}

}  // namespace
}  // namespace nightcity::citygml
