// Valid forms of coordinates, links and collections that are seldom written. Each holds the same
// square of 20 m by 10 m at height 100.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/citygml/read_file.h"
#include "tools/city/end_date.h"
#include "tools/citygml/citygml_head.h"
#include "tools/georeference/frame.h"

namespace nightcity::citygml {
namespace {

using namespace test;

const city::Ring square_of_20 = {{0, 0, 100}, {20, 0, 100}, {20, 10, 100}, {0, 10, 100}};

std::string house_of(const std::string& id, const std::string& content) {
  return "<bldg:Building gml:id=\"" + id + "\">" + content + "</bldg:Building>";
}

std::string surface_of(const std::string& coordinates) {
  return house_of(
      "b",
      boundary("RoofSurface",
               surface_member("<gml:Polygon gml:id=\"p\"><gml:exterior><gml:LinearRing>" +
                              coordinates + "</gml:LinearRing></gml:exterior></gml:Polygon>")));
}

city::Ring ring_of(const std::string& coordinates) {
  const City city = read_member(surface_of(coordinates));
  if (city.objects.size() != 1 || city.objects[0].polygons.size() != 1) return {};
  return city.objects[0].polygons[0].exterior;
}

TEST(CityGmlForms, CommentsAndCdataMayCutANumber) {
  EXPECT_EQ(ring_of("<gml:posList>0 0 1<!-- here -->00 20 0 100 20 <![CDATA[10 1]]>00 "
                    "0 10 100 0 0 100</gml:posList>"),
            square_of_20);
}

TEST(CityGmlForms, CoordinatesHaveTheSeparatorsThatTheyName) {
  for (const char* text :
       {"<gml:coordinates>0,0,100 20,0,100 20,10,100 0,10,100 0,0,100</gml:coordinates>",
        "<gml:coordinates cs=\" \" ts=\",\">0 0 100,20 0 100,20 10 100, 0 10 "
        "100,0 0 100</gml:coordinates>",
        "<gml:coordinates decimal=\",\" cs=\" \" ts=\";\">0,0 0,0 100,0;20,0 0,0 100,0;20,0 10,0 "
        "100,0;0,0 10,0 100,0;0,0 0,0 100,0</gml:coordinates>",
        "<gml:coordinates decimal=\",\" cs=\";\">0,0;0;1e2 20;0;100 20;10;100 0;10;100 "
        "0;0;100</gml:coordinates>",
        "<gml:coordinates>0, 0, 100 20, 0, 100\n20 , 10 , 100 0,10,100 0,0,100</gml:coordinates>",
        "<gml:coord><gml:X>0</gml:X><gml:Y>0</gml:Y><gml:Z>100</gml:Z></gml:coord>"
        "<gml:coord><gml:X>20</gml:X><gml:Y>0</gml:Y><gml:Z>100</gml:Z></gml:coord>"
        "<gml:coord><gml:X>20</gml:X><gml:Y>10</gml:Y><gml:Z>100</gml:Z></gml:coord>"
        "<gml:coord><gml:X>0</gml:X><gml:Y>10</gml:Y><gml:Z>100</gml:Z></gml:coord>"})
    EXPECT_EQ(ring_of(text), square_of_20) << text;
  const City broken =
      read_member(surface_of("<gml:coordinates>0,0,100,7 20,0,100 20,10,100</gml:coordinates>"));
  EXPECT_EQ(broken.report.skipped.at("polygon: ring with an incomplete vertex"), 1u);
}

TEST(CityGmlForms, AListThatIsClosedInThePlaneAloneLiesInThePlane) {
  // Twelve numbers are six places in the plane, or four in space; only the plane closes this ring.
  const city::Ring plan = {{0, 0, 0}, {20, 0, 0}, {20, 5, 0}, {10, 5, 0}, {10, 10, 0}};
  EXPECT_EQ(ring_of("<gml:posList>0 0 20 0 20 5 10 5 10 10 0 0</gml:posList>"), plan);
  EXPECT_EQ(ring_of("<gml:posList>0 0 20 0 20 10 0 10 0 0</gml:posList>").size(), 4u);
  EXPECT_EQ(ring_of("<gml:pos>0 0</gml:pos><gml:pos>20 0</gml:pos><gml:pos>20 5</gml:pos>"
                    "<gml:pos>10 5</gml:pos><gml:pos>10 10</gml:pos>"),
            plan);
  // A list that says three has three.
  EXPECT_EQ(
      ring_of("<gml:posList srsDimension=\"3\">0 0 20 0 20 5 10 5 10 10 0 0</gml:posList>").size(),
      4u);
  EXPECT_EQ(ring_of("<gml:posList>0 0 100 20 0 100 20 10 100 0 10 100 0 0 100</gml:posList>"),
            square_of_20);
}

TEST(CityGmlForms, LinksMayEncodeLettersAndNameTheirOwnFile) {
  const std::string roof = member(
      house_of("a", boundary("RoofSurface", surface_member(polygon("p\xC3\xA4", square_at_one)))));
  const auto text_of = [&](const std::string& link) {
    return city_model(member(house_of("b",
                                      "<bldg:lod2Solid><gml:Solid><gml:exterior>"
                                      "<gml:CompositeSurface><gml:surfaceMember xlink:href=\"" +
                                          link +
                                          "\"/></gml:CompositeSurface></gml:exterior></gml:Solid>"
                                          "</bldg:lod2Solid>")) +
                      roof);
  };
  const TemporaryFile file("");
  const std::string own = file.path().filename().string();
  for (const std::string& link :
       {std::string("#p%C3%A4"), own + "#p%C3%A4", "./" + own + "#p\xC3\xA4"}) {
    std::ofstream(file.path(), std::ios::binary) << text_of(link);
    const City city = read_file(file.path());
    EXPECT_TRUE(city.report.skipped.empty()) << link;
    ASSERT_TRUE(city.find("b")) << link;
    EXPECT_EQ(city.find("b")->polygons.size(), 1u) << link;
  }
}

TEST(CityGmlForms, CollectionsOfCollectionsAreReadThrough) {
  const std::string inner = "<wfs:member>" + building("b") + "</wfs:member>";
  for (const char* name : {"FeatureCollection", "Tuple"}) {
    std::string text = city_model("<wfs:member><wfs:" + std::string(name) + "><gml:boundedBy/>" +
                                  inner + inner + "</wfs:" + name + "></wfs:member>");
    text.insert(text.find(" xmlns:gml"), " xmlns:wfs=\"http://www.opengis.net/wfs/2.0\"");
    const City city = read(text);
    EXPECT_EQ(city.objects.size(), 2u) << name;
    EXPECT_TRUE(city.report.skipped.empty()) << name;
  }
}

TEST(CityGmlForms, TheNameOfACrsMayHoldEntities) {
  EXPECT_EQ(list_srs_names("<a srsName=\"PROJCS[&quot;x&quot;]&amp;y\" srsName='b'>"),
            (std::vector<std::string>{"PROJCS[\"x\"]&y", "b"}));
}

std::string furniture(const std::string& matrix, const std::string& place) {
  return member(
      "<frn:CityFurniture gml:id=\"f\"><frn:lod2ImplicitRepresentation><core:ImplicitGeometry>"
      "<core:transformationMatrix>" +
      matrix + "</core:transformationMatrix><core:relativeGMLGeometry><gml:MultiSurface>" +
      surface_member(polygon("p", "0 0 0 1 0 0 1 1 0 0 0 0")) +
      "</gml:MultiSurface></core:relativeGMLGeometry><core:referencePoint><gml:Point><gml:pos>" +
      place +
      "</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry>"
      "</frn:lod2ImplicitRepresentation></frn:CityFurniture>");
}

TEST(CityGmlForms, AMatrixIsHomogeneous) {
  const City city = read(city_model(furniture("40 0 0 2 0 20 0 0 0 0 2 0 0 0 0 2", "100 200 30")));
  EXPECT_EQ(city.objects.at(0).polygons.at(0).exterior,
            (city::Ring{{101, 200, 30}, {121, 200, 30}, {121, 210, 30}}));
  // One with its columns for rows says where it puts the shape in its last row.
  const City turned =
      read(city_model(furniture("20 0 0 0 0 10 0 0 0 0 1 0 1 0 0 1", "100 200 30")));
  EXPECT_EQ(turned.objects.at(0).polygons.at(0).exterior,
            (city::Ring{{101, 200, 30}, {121, 200, 30}, {121, 210, 30}}));
  const City both = read(city_model(furniture("1 0 0 5 0 1 0 0 0 0 1 0 5 5 5 1", "100 200 30")));
  EXPECT_EQ(both.report.skipped.at("implicit geometry: matrix that is none"), 1u);
}

TEST(CityGmlForms, ShapesAreInMetresWhereTheCityIsInDegrees) {
  std::string text = city_model(furniture("20 0 0 0 0 10 0 0 0 0 3 1 0 0 0 1", "35.68 139.75 30"));
  text.replace(text.find("EPSG:25833"), 10, "urn:ogc:def:crs:EPSG::6697");
  const City city = read(text);
  const city::Polygon& shape = city.objects.at(0).polygons.at(0);
  ASSERT_TRUE(shape.anchor);
  const std::vector<glm::dvec3> sample{*shape.anchor};
  const auto frame =
      georeference::CityFrame::from_srs_name("urn:ogc:def:crs:EPSG::6697", sample, {});
  city::Ring ring = shape.exterior;
  frame.to_projected(ring, shape.anchor);
  std::vector<glm::dvec3> place{*shape.anchor};
  frame.to_projected(place);
  const city::Ring expected = {{0, 0, 1}, {20, 0, 1}, {20, 10, 1}};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(glm::distance(ring[i] - place[0], expected[i]), 1e-6) << i;
}

TEST(CityGmlForms, AMeasuredHeightHasItsUnit) {
  for (const auto& [unit, metres] :
       {std::pair("m", 10.0), std::pair("#ft", 3.048), std::pair("urn:ogc:def:uom:UCUM::cm", 0.1),
        std::pair("http://www.opengis.net/def/uom/UCUM/0/%5Bft_i%5D", 3.048),
        std::pair("storeys", 10.0)}) {
    const City city = read_member(building(
        "b", "<bldg:measuredHeight uom=\"" + std::string(unit) + "\">10</bldg:measuredHeight>"));
    EXPECT_NEAR(city.objects.at(0).measured_height_m.value(), metres, 1e-12) << unit;
  }
}

TEST(CityGmlForms, WhatHasEndedIsLeftOutAndCounted) {
  using namespace std::chrono;
  const auto day = sys_days(2020y / May / 4);
  for (const char* past : {"2019", " 1998 ", "2020-05-03", "2020-05-03T23:00:00Z", "2019Z"})
    EXPECT_TRUE(city::is_past(past, day)) << past;
  for (const char* text : {"2020", "2053", "2020-05-04", "2020-13-01", "", "soon", "9999-12-31"})
    EXPECT_FALSE(city::is_past(text, day)) << text;
  const auto read_with = [](const std::string& property) {
    return read(city_model(member(building("a", property)) + member(building("b"))));
  };
  for (const char* property :
       {"<core:terminationDate>2001-01-01</core:terminationDate>",
        "<core:validTo>1990</core:validTo>", "<core:validTo>1990-02-03T00:00:00</core:validTo>",
        "<con:dateOfDemolition>2012-05-01</con:dateOfDemolition>",
        "<con:conditionOfConstruction>demolished</con:conditionOfConstruction>",
        "<con:conditionOfConstruction> projected </con:conditionOfConstruction>",
        "<con:conditionOfConstruction>http://inspire.ec.europa.eu/codelist/"
        "ConditionOfConstructionValue/declined</con:conditionOfConstruction>"}) {
    const City city = read_with(property);
    EXPECT_EQ(city.objects.size(), 1u) << property;
    EXPECT_EQ(city.report.skipped.at(city::ended_object), 1u);
    EXPECT_EQ(city.report.skipped.at("polygon: of an object that ended"), 3u);
  }
  for (const char* property :
       {"<core:validTo>9998</core:validTo>", "<con:dateOfDemolition>9998</con:dateOfDemolition>",
        "<con:conditionOfConstruction>functional</con:conditionOfConstruction>",
        "<con:conditionOfConstruction>ruin</con:conditionOfConstruction>",
        "<con:conditionOfConstruction>underConstruction</con:conditionOfConstruction>"})
    EXPECT_EQ(read_with(property).objects.size(), 2u) << property;
}

// Neither is valid, and both are written: what is meant is read, what cannot be is counted.
TEST(CityGmlForms, RingsBeyondTheSchemasAreHolesOrCounted) {
  const auto square = [](const std::string& from, const std::string& to) {
    return ring(from + " " + from + " 1 " + to + " " + from + " 1 " + to + " " + to + " 1 " + from +
                " " + to + " 1 " + from + " " + from + " 1");
  };
  const City city = read(city_model(member(house_of(
      "b", boundary("RoofSurface",
                    surface_member("<gml:Polygon><gml:exterior>" + square("0", "10") +
                                   "</gml:exterior><gml:interior>" + square("1", "2") +
                                   square("4", "6") + "</gml:interior><gml:exterior>" +
                                   square("20", "30") + "</gml:exterior></gml:Polygon>"))))));
  ASSERT_EQ(city.objects.at(0).polygons.size(), 1u);
  const city::Polygon& roof = city.objects[0].polygons[0];
  EXPECT_EQ(roof.exterior.front(), glm::dvec3(0, 0, 1));
  ASSERT_EQ(roof.interiors.size(), 2u);
  EXPECT_EQ(roof.interiors[1].front(), glm::dvec3(4, 4, 1));
  EXPECT_EQ(city.report.skipped.at("ring: a further exterior of its polygon"), 1u);
}

// A group may have an outline of its own beside its members.
TEST(CityGmlForms, TheGeometryOfAGroupIsCounted) {
  const City city = read(city_model(
      member("<grp:CityObjectGroup><grp:groupMember>" + building("a") + "</grp:groupMember>" +
             "<grp:geometry>" + multi_surface(surface_member(polygon("p", square_at_one))) +
             "</grp:geometry></grp:CityObjectGroup>")));
  EXPECT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.report.skipped.at("grp:CityObjectGroup"), 1u);
  EXPECT_EQ(city.report.skipped.at("polygon: in grp:geometry"), 1u);
}

// Without a measured height storeys say how high a footprint's block is.
TEST(CityGmlForms, ABlockIsAsHighAsItsStoreys) {
  const std::string plan = "<bldg:lod0FootPrint>" +
                           multi_surface(surface_member(polygon("p", square_at_one))) +
                           "</bldg:lod0FootPrint>";
  struct Case {
    const char* attributes;
    double top;
  };
  for (const Case& c :
       {Case{"<bldg:storeysAboveGround>3</bldg:storeysAboveGround>", 10},
        Case{"<bldg:storeysAboveGround>3</bldg:storeysAboveGround><bldg:storeyHeightsAboveGround "
             "uom=\"m\">4 3 3.5</bldg:storeyHeightsAboveGround>",
             11.5},
        Case{"<bldg:storeyHeightsAboveGround uom=\"cm\">400 300</bldg:storeyHeightsAboveGround>",
             8},
        Case{"<bldg:measuredHeight uom=\"m\">7</bldg:measuredHeight>"
             "<bldg:storeysAboveGround>3</bldg:storeysAboveGround>",
             8},
        Case{"<bldg:measuredHeight uom=\"m\">-9999</bldg:measuredHeight>"
             "<bldg:storeysAboveGround>2</bldg:storeysAboveGround>",
             7},
        // CityGML 3.0: elevations of the roof and of the ground, with or without their place.
        Case{"<con:elevation><con:Elevation><con:elevationReference>highestRoofEdge"
             "</con:elevationReference><con:elevationValue>47.5</con:elevationValue>"
             "</con:Elevation></con:elevation><con:elevation><con:Elevation>"
             "<con:elevationReference>lowestGroundPoint</con:elevationReference>"
             "<con:elevationValue>5 6 35.5</con:elevationValue></con:Elevation></con:elevation>"
             "<bldg:storeysAboveGround>3</bldg:storeysAboveGround>",
             13},
        Case{"<con:elevation><con:Elevation><con:elevationReference>highestRoofEdge"
             "</con:elevationReference><con:elevationValue>47.5</con:elevationValue>"
             "</con:Elevation></con:elevation>",
             1},
        Case{"<bldg:storeysAboveGround>0</bldg:storeysAboveGround>", 1}}) {
    const City city = read(city_model(member(house_of("b", c.attributes + plan))));
    ASSERT_EQ(city.objects.size(), 1u);
    double top = -1;
    for (const city::Polygon& one : city.objects[0].polygons)
      for (const glm::dvec3& p : one.exterior) top = std::max(top, p.z);
    EXPECT_NEAR(top, c.top, 1e-9) << c.attributes;
  }
}

TEST(CityGmlForms, ABlockIsAsHighAsMeasuredInTheUnitOfItsHeights) {
  const std::string plan = member(house_of(
      "b",
      "<bldg:measuredHeight uom=\"m\">9</bldg:measuredHeight>"
      "<bldg:lod0FootPrint>" +
          multi_surface(surface_member(polygon("p", square_at_one))) + "</bldg:lod0FootPrint>"));
  city::ReadOptions options;
  options.height_unit_m = 0.3048;
  const City city = read(city_model(plan), options);
  double top = 0;
  for (const city::Polygon& polygon : city.objects.at(0).polygons)
    for (const glm::dvec3& p : polygon.exterior) top = std::max(top, p.z);
  EXPECT_NEAR(top, 1 + 9 / 0.3048, 1e-9);
}

}  // namespace
}  // namespace nightcity::citygml
