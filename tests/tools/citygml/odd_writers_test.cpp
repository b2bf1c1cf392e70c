// CityGML by writers who separate numbers, order matrices and nest objects in ways of their own.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>

#include "tests/tools/citygml/read_file.h"
#include "tools/city/ring.h"
#include "tools/citygml/number_list.h"

namespace nightcity::citygml {
namespace {

using namespace test;

std::string member_of(const std::string& id, const std::string& content) {
  return member("<bldg:Building gml:id=\"" + id + "\">" + content + "</bldg:Building>");
}

City read_square(const std::string& pos_list) {
  return read(city_model(
      member_of("b", "<bldg:lod1MultiSurface>" +
                         multi_surface(surface_member(
                             "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + pos_list +
                             "</gml:posList></gml:LinearRing></gml:exterior>"
                             "</gml:Polygon>")) +
                         "</bldg:lod1MultiSurface>")));
}

TEST(CityGmlOddWriters, ListsOfNumbersMayBeSeparatedOtherwise) {
  const city::Ring square{{0, 0, 5}, {1.5, 0, 5}, {1.5, 2, 5}, {0, 2, 5}};
  for (const char* list :
       {"0\u00A00\u00A05 1.5 0 5 1.5 2 5 0 2 5 0 0 5", "0,0,5 1.5,0,5 1.5,2,5 0,2,5 0,0,5",
        "0, 0, 5, 1.5, 0, 5, 1.5, 2, 5, 0, 2, 5, 0, 0, 5",
        "0 0 5; 1.5 0 5; 1.5 2 5; 0 2 5; 0 0 5"}) {
    const City city = read_square(list);
    ASSERT_EQ(city.objects.at(0).polygons.size(), 1u) << list;
    EXPECT_EQ(city.objects[0].polygons[0].exterior, square) << list;
  }
  for (const char* list : {"0 0 5 x 0 5 1 2 5 0 0 5", "0 0 5 1.5,0 0 5 1 2 5 0 0 5",
                           "0 0 5 1,5 0 5 1,5 2 5 0 2 5 0 0 5"})
    EXPECT_EQ(read_square(list).objects.at(0).polygons.size(), 0u) << list;
  EXPECT_EQ(mend_number_list("1 2 3"), "1 2 3");
}

City read_placed(const std::string& matrix, const std::string& place) {
  return read(city_model(member(
      "<frn:CityFurniture gml:id=\"f\"><frn:lod2ImplicitRepresentation><core:ImplicitGeometry>"
      "<core:transformationMatrix>" +
      matrix + "</core:transformationMatrix><core:relativeGMLGeometry>" +
      multi_surface(surface_member(polygon("", square_at_one))) +
      "</core:relativeGMLGeometry><core:referencePoint><gml:Point>" + place +
      "</gml:Point></core:referencePoint></core:ImplicitGeometry>"
      "</frn:lod2ImplicitRepresentation></frn:CityFurniture>")));
}

TEST(CityGmlOddWriters, MatricesInColumnsWithCommasAndPlacesByCoordinates) {
  const std::string pos = "<gml:pos>100 200 0</gml:pos>";
  const glm::dvec3 expected(105, 206, 8);
  for (const char* matrix :
       {"1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1", "1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1",
        "1,0,0,5,0,1,0,6,0,0,1,7,0,0,0,1", "2 0 0 10 0 2 0 12 0 0 2 14 0 0 0 2"}) {
    const City city = read_placed(matrix, pos);
    ASSERT_EQ(city.objects.at(0).polygons.size(), 1u) << matrix;
    EXPECT_EQ(city.objects[0].polygons[0].exterior.front(), expected) << matrix;
  }
  for (const char* place : {"<gml:coordinates>100,200,0</gml:coordinates>",
                            "<gml:coord><gml:X>100</gml:X><gml:Y>200</gml:Y><gml:Z>0</gml:Z>"
                            "</gml:coord>"})
    EXPECT_EQ(read_placed("1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1", place)
                  .objects.at(0)
                  .polygons.at(0)
                  .exterior.front(),
              expected);
  const City perspective = read_placed("1 0 0 5 0 1 0 6 0 0 1 7 1 0 0 1", pos);
  EXPECT_EQ(perspective.report.skipped.at("implicit geometry: matrix that is none"), 1u);
}

TEST(CityGmlOddWriters, StoreysUnderOtherNamesMakeBlocks) {
  for (const char* name : {"storeys", "AnzahlGeschosse", "number_of_floors", "NB_ETAGES"}) {
    const City city = read(city_model(
        member_of("b", "<gen:intAttribute name=\"" + std::string(name) +
                           "\"><gen:value>3</gen:value></gen:intAttribute><bldg:lod0FootPrint>" +
                           multi_surface(surface_member(polygon("", square_at_zero))) +
                           "</bldg:lod0FootPrint>")));
    EXPECT_EQ(city.objects.at(0).storeys_above_ground, 3) << name;
    EXPECT_EQ(city.report.extruded, 1u) << name;
  }
}

TEST(CityGmlOddWriters, StoreysAreTheBuildingWhereItHasNothingElse) {
  const std::string storey =
      "<bldg:buildingSubdivision><bldg:Storey gml:id=\"s\"><core:lod2MultiSurface>" +
      multi_surface(surface_member(polygon("", square_at_one))) +
      "</core:lod2MultiSurface></bldg:Storey></bldg:buildingSubdivision>";
  const City hollow = read(city_model(member_of("b", storey), "3.0"));
  EXPECT_EQ(hollow.objects.at(0).polygons.size(), 1u);
  const std::string own = boundary("WallSurface", surface_member(polygon("", south_wall)));
  const City whole = read(city_model(member_of("b", own + storey), "3.0"));
  ASSERT_EQ(whole.objects.at(0).polygons.size(), 1u);
  EXPECT_EQ(whole.objects[0].polygons[0].surface, city::SurfaceType::wall);
  EXPECT_EQ(whole.report.skipped.at("bldg:buildingSubdivision"), 1u);
}

TEST(CityGmlOddWriters, GroupsOfGroupsHaveTheirMembers) {
  const auto group = [](const std::string& inside) {
    return "<grp:CityObjectGroup xmlns:grp=\"x\"><grp:groupMember>" + inside +
           "</grp:groupMember></grp:CityObjectGroup>";
  };
  EXPECT_EQ(read_member(group(group(building("b")))).objects.size(), 1u);
  std::string deep = building("b");
  for (int i = 0; i < 60; ++i) deep = group(deep);
  EXPECT_EQ(read_member(deep).objects.size(), 1u);
}

TEST(CityGmlOddWriters, AHoleThatEnclosesItsOutlineIsTheOutline) {
  const auto read_rings = [](const std::string& outer, const std::string& hole) {
    return read(city_model(member_of(
        "b", "<bldg:lod1MultiSurface>" +
                 multi_surface(surface_member("<gml:Polygon><gml:exterior>" + ring(outer) +
                                              "</gml:exterior><gml:interior>" + ring(hole) +
                                              "</gml:interior></gml:Polygon>")) +
                 "</bldg:lod1MultiSurface>")));
  };
  const char *large = "0 0 0 9 0 0 9 9 0 0 9 0 0 0 0", *small = "2 2 0 4 2 0 4 4 0 2 4 0 2 2 0",
             *turned = "0 0 0 0 9 0 9 9 0 9 0 0 0 0 0";
  for (const char* hole : {large, turned}) {
    const City city = read_rings(small, hole);
    const city::Polygon& polygon = city.objects.at(0).polygons.at(0);
    EXPECT_EQ(city::area_vector(polygon.exterior), glm::dvec3(0, 0, 81)) << "it still faces up";
    EXPECT_EQ(polygon.interiors.size(), 1u);
    EXPECT_EQ(city.report.assumed.at("outline of a polygon: the file has it as a hole"), 1u);
  }
  EXPECT_TRUE(read_rings(large, small).report.assumed.empty());
  // A hole elsewhere, however large, is none.
  EXPECT_TRUE(read_rings("20 0 0 22 0 0 22 2 0 20 2 0 20 0 0", large).report.assumed.empty());
}

// Returns level squares of 1 m2 at these heights, under LoD0's two properties.
std::string plans(const std::string& foot, const std::string& top) {
  const auto at = [](const std::string& name, const std::string& z) {
    const std::string list = "0 0 " + z + " 1 0 " + z + " 1 1 " + z + " 0 1 " + z + " 0 0 " + z;
    return "<bldg:" + name + ">" + multi_surface(surface_member(polygon("", list))) +
           "</bldg:" + name + ">";
  };
  return at("lod0FootPrint", foot) + at("lod0RoofEdge", top);
}

double wall_area(const city::CityObject& object) {
  double sum = 0;
  for (const city::Polygon& polygon : object.polygons)
    if (polygon.surface == city::SurfaceType::wall)
      sum += glm::length(city::area_vector(polygon.exterior));
  return sum;
}

TEST(CityGmlOddWriters, AFootprintBelowARoofEdgeIsABlock) {
  struct Case {
    std::string said;
    double height;
  };
  for (const Case& c :
       {Case{"", 10}, Case{"<bldg:storeysAboveGround>2</bldg:storeysAboveGround>", 10},
        Case{"<bldg:measuredHeight>12</bldg:measuredHeight>", 12}}) {
    const City city = read(city_model(member_of("b", c.said + plans("15", "25"))));
    EXPECT_EQ(city.report.extruded, 1u);
    EXPECT_EQ(city.objects.at(0).polygons.size(), 6u);
    EXPECT_NEAR(wall_area(city.objects[0]), 4 * c.height, 1e-9) << c.said;
  }
  city::ReadOptions feet;
  feet.height_unit_m = 0.3048;
  EXPECT_NEAR(wall_area(read(city_model(member_of("b", plans("15", "25"))), feet).objects.at(0)),
              40, 1e-9);
  EXPECT_EQ(read(city_model(member_of("b", plans("25", "15")))).report.flat, 1u);
}

// Footprints follow the ground, or are level but for a millimetre.
TEST(CityGmlOddWriters, PlansThatAreNotQuiteLevelAreBlocks) {
  struct Case {
    std::string property, list;
    double foot;
  };
  const std::string tall = "<bldg:measuredHeight>9</bldg:measuredHeight>";
  for (const Case& c : {Case{"lod0FootPrint", "0 0 30 1 0 30.4 1 1 31 0 1 30.2 0 0 30", 30},
                        Case{"lod0FootPrint", "0 0 30.001 1 0 30 1 1 30 0 1 30.002 0 0 30.001", 30},
                        Case{"lod0RoofEdge", "0 0 39 1 0 39 1 1 39.5 0 1 39.5 0 0 39", 30.5}}) {
    const City city =
        read(city_model(member_of("b", tall + "<bldg:" + c.property + ">" +
                                           multi_surface(surface_member(polygon("", c.list))) +
                                           "</bldg:" + c.property + ">")));
    EXPECT_EQ(city.report.extruded, 1u) << c.list;
    EXPECT_NEAR(wall_area(city.objects.at(0)), 36, 1e-9) << c.list;
    EXPECT_EQ(city.objects[0].polygons.at(0).exterior.at(0).z, c.foot) << c.list;
  }
  const City wall = read(city_model(member_of(
      "b", tall + "<bldg:lod0FootPrint>" + multi_surface(surface_member(polygon("", south_wall))) +
               "</bldg:lod0FootPrint>")));
  EXPECT_EQ(wall.report.extruded, 0u);
}

TEST(CityGmlOddWriters, ALevelOfAGroundPlateAloneIsNoBuilding) {
  const std::string block = "<bldg:lod1MultiSurface>" +
                            multi_surface(surface_member(polygon("", south_wall))) +
                            "</bldg:lod1MultiSurface>";
  const std::string plate = boundary("GroundSurface", surface_member(polygon("", square_at_zero)));
  const City city = read(city_model(member_of("b", plate + block)));
  ASSERT_EQ(city.objects.at(0).polygons.size(), 1u);
  EXPECT_EQ(city.objects[0].lod, 1);
  EXPECT_EQ(city.report.skipped.at("polygon: lod2, another LoD taken"), 1u);
  // A part of nothing else keeps it.
  const City parts = read(city_model(
      member_of("b", "<bldg:consistsOfBuildingPart><bldg:BuildingPart>" + plate +
                         "</bldg:BuildingPart></bldg:consistsOfBuildingPart>" +
                         boundary("WallSurface", surface_member(polygon("", south_wall))))));
  EXPECT_EQ(parts.objects.at(0).polygons.size(), 2u);
}

TEST(CityGmlOddWriters, SurfacesWithoutTheirBuildingAreCounted) {
  const City city =
      read(city_model(member("<bldg:WallSurface gml:id=\"w\"><bldg:lod2MultiSurface>" +
                             multi_surface(surface_member(polygon("", south_wall))) +
                             "</bldg:lod2MultiSurface></bldg:WallSurface>")));
  EXPECT_EQ(city.report.polygons, 1u);
  EXPECT_EQ(city.report.skipped.at(
                "building of a bldg:WallSurface that is a member of its own: no windows"),
            1u);
}

TEST(CityGmlOddWriters, HeightsInAnotherUnitThanTheMeasuredOnesAreTold) {
  const auto warn = [](const std::string& measured, int count) {
    std::string members;
    for (int i = 0; i < count; ++i)
      members += member(building("b" + std::to_string(i),
                                 "<bldg:measuredHeight>" + measured + "</bldg:measuredHeight>"));
    const City city = read(city_model(members));  // unit boxes
    return city.report.warnings.empty() ? std::string() : city.report.warnings[0];
  };
  EXPECT_NE(warn("0.3048", 3).find("3 of 3 buildings with a measured height are more than 2.5"),
            std::string::npos);
  EXPECT_NE(warn("100", 4).find("less than 0.4"), std::string::npos);
  EXPECT_EQ(warn("1.5", 4), "");
  EXPECT_EQ(warn("100", 2), "");  // too few to tell
}

}  // namespace
}  // namespace nightcity::citygml
