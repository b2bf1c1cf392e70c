// City objects of CityJSON 1.0 to 2.0, from files with known content.
#include "tools/cityjson/read_cityjson.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "formats/error.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/cityjson/read_text.h"
#include "tests/tools/cityjson/small_cityjson.h"
#include "tools/citygml/read_citygml.h"
#include "tools/mesh/triangulate.h"

namespace nightcity::cityjson {
namespace {

using namespace test;

std::map<city::SurfaceType, int> count_surfaces(const city::CityObject& object) {
  std::map<city::SurfaceType, int> counts;
  for (const city::Polygon& polygon : object.polygons) ++counts[polygon.surface];
  return counts;
}

TEST(CityJson, ACubeHasItsVolumeAreaAndSurfaces) {
  const City read = read_city(city_json(object("a", "Building", solid("\"2\"", box_semantics()))));
  ASSERT_EQ(read.objects.size(), 1u);
  const city::CityObject& cube = read.objects[0];
  EXPECT_EQ(cube.id, "a");
  EXPECT_EQ(cube.type, city::ObjectType::building);
  EXPECT_EQ(cube.class_name, "Building");
  EXPECT_EQ(cube.lod, 2);
  EXPECT_NEAR(volume(cube), 24, 1e-9);
  EXPECT_NEAR(area(cube), 2 * (6 + 8 + 12), 1e-9);
  EXPECT_EQ(cube.polygons[0].exterior[0], glm::dvec3(10, 20, 30));
  EXPECT_EQ(count_surfaces(cube), (std::map<city::SurfaceType, int>{{city::SurfaceType::ground, 1},
                                                                    {city::SurfaceType::roof, 1},
                                                                    {city::SurfaceType::wall, 4}}));
  EXPECT_EQ(read.report.version, "2.0");
  EXPECT_EQ(read.report.srs_name, "EPSG:7415");
  EXPECT_EQ(read.report.polygons, 6u);
  EXPECT_TRUE(read.report.skipped.empty());
}

TEST(CityJson, EveryGeometryTypeGivesTheSameCube) {
  const std::string faces = box_faces;
  for (const std::string& geometry :
       {"\"type\":\"MultiSurface\",\"boundaries\":[" + faces + "]",
        "\"type\":\"CompositeSurface\",\"boundaries\":[" + faces + "]",
        "\"type\":\"Solid\",\"boundaries\":[[" + faces + "]]",
        "\"type\":\"MultiSolid\",\"boundaries\":[[[" + faces + "]]]",
        "\"type\":\"CompositeSolid\",\"boundaries\":[[[" + faces + "]]]"}) {
    const City read =
        read_city(city_json(object("a", "Building", "{\"lod\":\"1\"," + geometry + "}")));
    ASSERT_EQ(read.objects.size(), 1u) << geometry;
    EXPECT_NEAR(volume(read.objects[0]), 24, 1e-9) << geometry;
    EXPECT_EQ(read.objects[0].lod, 1);
  }
}

TEST(CityJson, VersionOneHasPlainNumbersAndAUrn) {
  // No transform, "lod" a number, a URN, and members in another order.
  const City read = read_city(
      "{\"vertices\":[[0.5,0,0],[1.5,0,0],[1.5,1,0],[0.5,1,0]],\"CityObjects\":{" +
      object("a", "BridgeConstructionElement",
             "{\"type\":\"MultiSurface\",\"lod\":2,\"boundaries\":[[[0,1,2,3]]]}") +
      "},\"metadata\":{\"referenceSystem\":\"urn:ogc:def:crs:EPSG::28992\"},\"version\":\"1.0\","
      "\"type\":\"CityJSON\"}");
  ASSERT_EQ(read.objects.size(), 1u);
  EXPECT_EQ(read.objects[0].type, city::ObjectType::bridge);
  EXPECT_NEAR(area(read.objects[0]), 1, 1e-12);
  EXPECT_EQ(read.objects[0].polygons[0].exterior[0].x, 0.5);
  EXPECT_EQ(read.report.srs_name, "EPSG:28992");
}

TEST(CityJson, NamesOfReferenceSystemsKeepNoPromiseOfAxes) {
  const auto srs_name = [](const std::string& name) {
    const TemporaryFile file(
        "{\"type\":\"CityJSON\",\"version\":\"1.1\",\"CityObjects\":{},\"vertices\":[],"
        "\"metadata\":{\"referenceSystem\":\"" +
            name + "\"}}",
        ".json");
    return read_cityjson_head(file.path()).srs_name;
  };
  for (const char* name :
       {"https://www.opengis.net/def/crs/EPSG/0/7415", "urn:ogc:def:crs:EPSG::7415", "EPSG:7415",
        "http://www.opengis.net/def/crs/epsg/0/7415"})
    EXPECT_EQ(srs_name(name), "EPSG:7415") << name;
  EXPECT_EQ(srs_name("urn:ogc:def:crs,crs:EPSG::28992,crs:EPSG::5709"),
            "urn:ogc:def:crs,crs:EPSG::28992,crs:EPSG::5709");
  for (const char* name :
       {"http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/28992&"
        "2=http://www.opengis.net/def/crs/EPSG/0/5709",
        "EPSG:28992+EPSG:5709", "EPSG:28992+5709"})
    EXPECT_EQ(srs_name(name), "EPSG:28992+5709") << name;
  EXPECT_EQ(srs_name("a local grid"), "a local grid");
}

TEST(CityJson, AReferenceSystemThatIsANumberIsACodeAndOthersAreCounted) {
  const auto read = [](const std::string& system) {
    return read_city(
               "{\"type\":\"CityJSON\",\"version\":\"1.0\",\"metadata\":{\"referenceSystem\":" +
               system + "},\"CityObjects\":{},\"vertices\":[]}")
        .report;
  };
  EXPECT_EQ(read("28992").srs_name, "28992");
  EXPECT_TRUE(read("28992").skipped.empty());
  EXPECT_EQ(read("{\"type\":\"ProjectedCRS\"}").skipped.at("referenceSystem that is no text"), 1u);
}

TEST(CityJson, AReferenceSystemMayBePROJJSON) {
  const auto srs_name = [](const std::string& system) {
    return read_city(
               "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"metadata\":{\"referenceSystem\":" +
               system + "},\"CityObjects\":{},\"vertices\":[]}")
        .report.srs_name;
  };
  EXPECT_EQ(srs_name(R"({"type":"ProjectedCRS","name":"ETRS89 / UTM zone 33N",
                         "id":{"authority":"EPSG","code":25833}})"),
            "EPSG:25833");
  EXPECT_EQ(srs_name(R"({"type":"CompoundCRS", "name":"grid"})"),
            R"({"type":"CompoundCRS","name":"grid"})")
      << "without a code PROJ reads all of it";
  EXPECT_EQ(srs_name(R"({"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::28992"}})"),
            "EPSG:28992");
}

TEST(CityJson, TheFinestOfRefinedLevelsIsTaken) {
  const std::string square =
      "{\"type\":\"MultiSurface\",\"lod\":\"0\",\"boundaries\":[[[0,1,2,3]]]}";
  const std::string text =
      city_json(object("a", "Building",
                       square + "," + solid("\"1.2\"") + "," + solid("\"1.3\"") + "," +
                           solid("\"2.2\"", box_semantics())));
  city::ReadOptions options;
  options.max_lod = 1;
  const City one = read_city(text, options);
  EXPECT_EQ(one.objects[0].lod, 1);
  EXPECT_EQ(one.objects[0].polygons.size(), 6u);
  EXPECT_EQ(one.report.skipped.at("polygon: a refined LoD, a finer one taken"), 6u);
  EXPECT_EQ(one.report.skipped.at("polygon: lod2, another LoD taken"), 6u);
  options.max_lod = 2;
  EXPECT_EQ(read_city(text, options).objects[0].lod, 2);
}

TEST(CityJson, AFootprintWithAHeightBecomesABlock) {
  const City read = read_city(city_json(object(
      "a", "Building", "{\"type\":\"MultiSurface\",\"lod\":\"0\",\"boundaries\":[[[0,1,2,3]]]}",
      "\"attributes\":{\"measuredHeight\":5}")));
  EXPECT_EQ(read.report.extruded, 1u);
  EXPECT_NEAR(volume(read.objects[0]), 2 * 3 * 5, 1e-9);
  EXPECT_EQ(read.report.warnings.size(), 1u);
}

TEST(CityJson, PartsAndInstallationsAreOneBuildingWhereverTheyStand) {
  const std::string part = "{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":[[[0,1,5,4]]]}";
  const std::string roof = "{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":[[[4,5,6,7]]]}";
  const City read = read_city(city_json(
      object("part", "BuildingPart", part,
             "\"parents\":[\"b\\u00e9\"],\"attributes\":{\"storeysAboveGround\":3}") +
      ",\"b\\u00e9\":{\"type\":\"Building\",\"children\":[\"part\",\"chimney\",\"room\",\"lost\"],"
      "\"attributes\":{\"storeysAboveGround\":2,\"function\":[\"1000\",\"1010\"]}}," +
      object("room", "BuildingRoom", solid(), "\"parents\":[\"b\\u00e9\"]") + "," +
      object("chimney", "BuildingInstallation", roof, "\"parents\":[\"b\\u00e9\"]") + "," +
      object("orphan", "BuildingPart", part, "\"parents\":[\"elsewhere\"]")));
  ASSERT_EQ(read.objects.size(), 2u);
  EXPECT_EQ(read.objects[0].id, "b\u00e9");
  EXPECT_EQ(read.objects[0].polygons.size(), 2u);
  EXPECT_EQ(read.objects[0].storeys_above_ground, 3);
  EXPECT_EQ(read.objects[0].function, "1000;1010");
  EXPECT_EQ(read.objects[1].id, "orphan");
  EXPECT_EQ(read.report.skipped.at("polygon: inside a building"), 6u);
  EXPECT_EQ(read.report.skipped.at("BuildingRoom"), 1u);
  EXPECT_EQ(read.report.skipped.at("child that is not in the file"), 1u);
}

TEST(CityJson, BuildingsOfAGroupStayObjectsOfTheirOwn) {
  const City read =
      read_city(city_json("\"g\":{\"type\":\"CityObjectGroup\",\"children\":[\"a\"]}," +
                          object("a", "Building", solid(), "\"parents\":[\"g\"]")));
  ASSERT_EQ(read.objects.size(), 1u);
  EXPECT_EQ(read.objects[0].id, "a");
  EXPECT_EQ(read.report.skipped.at("CityObjectGroup"), 1u);
}

TEST(CityJson, AttributesAndAddressesAreThoseOfCityGml) {
  const City read = read_city(city_json(
      object(
          "a", "Building", solid(),
          "\"attributes\":{\"yearOfConstruction\":1984,\"measuredHeight\":12.5,\"class\":\"1000\","
          "\"usage\":\"shop\",\"storeyHeightsAboveGround\":[3.5,2.75],\"owner\":\"x\"},"
          "\"address\":[{\"Country\":\"Canada\",\"Locality\":\"Chibougamau\","
          "\"ThoroughfareNumber\":\"1\",\"ThoroughfareName\":\"rue de la Patate\","
          "\"Postcode\":\"H0H 0H0\"}]") +
      "," +
      object("b", "Building", solid(),
             "\"attributes\":{\"oorspronkelijkbouwjaar\":2003,\"b3_bouwlagen\":2}")));
  const city::CityObject& a = read.objects[0];
  EXPECT_EQ(a.year, "1984");
  EXPECT_EQ(a.measured_height_m, 12.5);
  EXPECT_EQ(a.building_class, "1000");
  EXPECT_EQ(a.usage, "shop");
  EXPECT_EQ(a.storey_heights_m, (std::vector<double>{3.5, 2.75}));
  EXPECT_EQ(a.address, "rue de la Patate 1, H0H 0H0 Chibougamau, Canada");
  EXPECT_EQ(read.report.skipped.at("attribute"), 1u);
  EXPECT_EQ(read.objects[1].year, "2003");
  EXPECT_EQ(read.objects[1].storeys_above_ground, 2);
}

TEST(CityJson, SemanticsOfAllKinds) {
  const std::string geometry =
      "{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":[" + std::string(box_faces) +
      "],\"semantics\":{\"surfaces\":[{\"type\":\"Door\"},{\"type\":\"InteriorWallSurface\"},"
      "{\"type\":\"+Patio\"},{\"type\":\"TrafficArea\",\"function\":\"2\"}],"
      "\"values\":[0,1,2,3,null]}}";
  const City read = read_city(city_json(object("a", "Road", geometry)));
  const city::CityObject& road = read.objects[0];
  ASSERT_EQ(road.polygons.size(), 5u);
  EXPECT_EQ(road.polygons[0].surface, city::SurfaceType::door);
  EXPECT_EQ(road.polygons[1].surface, city::SurfaceType::unknown);
  EXPECT_EQ(road.polygons[2].surface, city::SurfaceType::traffic_area);
  EXPECT_EQ(road.polygons[2].area_function, 2);
  EXPECT_EQ(road.polygons[4].surface, city::SurfaceType::unknown) << "values end before it";
  EXPECT_EQ(read.report.skipped.at("polygon: inside a building"), 1u);
  EXPECT_EQ(read.report.skipped.at("surface type +Patio"), 1u);
}

TEST(CityJson, MaterialsColourPolygonsAndTexturesAreCounted) {
  const std::string appearance =
      "\"appearance\":{\"default-theme-material\":\"day\",\"materials\":[{\"name\":\"red\","
      "\"diffuseColor\":[1,0,0]},{\"name\":\"plain\"},{\"name\":\"blue\",\"diffuseColor\":[0,0,1]}]"
      ","
      "\"textures\":[{\"type\":\"PNG\",\"image\":\"a.png\"}]}";
  const City read = read_city(city_json(
      object("a", "Building",
             solid("\"2\"",
                   "\"material\":{\"other\":{\"value\":0},\"day\":{\"values\":"
                   "[[2,null,1,0,9]]}},\"texture\":{\"t\":{\"values\":[[[[0]]]]}}")) +
          "," + object("b", "Building", solid("\"2\"", "\"material\":{\"x\":{\"value\":2}}")),
      appearance));
  const auto& faces = read.objects[0].polygons;
  EXPECT_EQ(faces[0].diffuse_colour, glm::vec3(0, 0, 1));
  EXPECT_FALSE(faces[1].diffuse_colour);
  EXPECT_FALSE(faces[2].diffuse_colour) << "a material without a colour";
  EXPECT_EQ(faces[3].diffuse_colour, glm::vec3(1, 0, 0));
  EXPECT_FALSE(faces[4].diffuse_colour) << "a material that is not there";
  EXPECT_EQ(read.objects[1].polygons[0].diffuse_colour, glm::vec3(0, 0, 1));
  EXPECT_EQ(read.report.skipped.at("texture"), 1u);
  EXPECT_EQ(read.report.skipped.at("texture of a geometry"), 1u);
}

const std::string unit_triangle =
    "\"geometry-templates\":{\"templates\":[{\"type\":\"MultiSurface\",\"lod\":\"2\","
    "\"boundaries\":[[[0,1,2]]]}],\"vertices-templates\":[[0,0,0],[1,0,0],[0,1,0]]}";

TEST(CityJson, TemplatesArePlacedByTheirMatrix) {
  // The unit triangle, scaled by 2, turned by 90 degrees about the vertical and put onto vertex 6.
  const std::string instance =
      "{\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[6],"
      "\"transformationMatrix\":[0,-2,0,0, 2,0,0,0, 0,0,2,0.5, 0,0,0,1]}";
  const City read =
      read_city(city_json(object("t", "SolitaryVegetationObject", instance), unit_triangle));
  ASSERT_EQ(read.objects.size(), 1u);
  ASSERT_EQ(read.objects[0].polygons.size(), 1u);
  EXPECT_EQ(read.objects[0].lod, 2);
  const city::Ring expected{{12, 23, 34.5}, {12, 25, 34.5}, {10, 23, 34.5}};
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(glm::distance(read.objects[0].polygons[0].exterior[i], expected[i]), 1e-12);
}

TEST(CityJson, APlantHasItsSizesAndStandsAtItsPointOrTemplate) {
  const std::string attributes =
      "\"attributes\":{\"height\":12.5,\"crownDiameter\":\"6\",\"trunkDiameter\":-1,"
      "\"species\":\"Acer\",\"class\":\"1070\"}";
  const std::string instance =
      "{\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[6],"
      "\"transformationMatrix\":[1,0,0,0, 0,1,0,0, 0,0,1,0.5, 0,0,0,1]}";
  const std::string point = "{\"type\":\"MultiPoint\",\"lod\":\"0\",\"boundaries\":[6]}";
  const City read =
      read_city(city_json(object("t", "SolitaryVegetationObject", instance, attributes) + "," +
                              object("p", "SolitaryVegetationObject", point) + "," +
                              object("f", "CityFurniture", instance),
                          unit_triangle));
  ASSERT_EQ(read.objects.size(), 3u);
  const city::CityObject& tree = *read.find("t");
  ASSERT_TRUE(tree.plant);
  EXPECT_EQ(tree.plant->height_m, 12.5);
  EXPECT_EQ(tree.plant->crown_m, 6);
  EXPECT_FALSE(tree.plant->trunk_m);
  EXPECT_EQ(tree.plant->odd_sizes, 1);
  EXPECT_EQ(tree.plant->species, "Acer");
  EXPECT_EQ(tree.building_class, "1070");
  EXPECT_EQ(tree.points, (std::vector<glm::dvec3>{{12, 23, 34.5}}));
  EXPECT_EQ(read.find("p")->points, (std::vector<glm::dvec3>{{12, 23, 34}}));
  EXPECT_TRUE(read.find("f")->points.empty());
}

TEST(CityJson, WhatHasEndedIsLeftOutAndCounted) {
  const auto read = [](const std::string& attributes) {
    return read_city(
        city_json(object("b", "Building", solid(), "\"attributes\":{" + attributes + "}") + "," +
                  object("c", "Building", solid())));
  };
  for (const char* past :
       {"\"validTo\":1990", "\"terminationDate\":\"2001-02-03\"",
        "\"dateOfDemolition\":\"2012-05-01\"", "\"conditionOfConstruction\":\"demolished\""}) {
    const City city = read(past);
    ASSERT_EQ(city.objects.size(), 1u) << past;
    EXPECT_EQ(city.objects[0].id, "c");
    EXPECT_EQ(city.report.skipped.at("polygon: of an object that ended"), 6u);
  }
  EXPECT_EQ(read("\"validTo\":9998").objects.size(), 2u);
  EXPECT_EQ(read("\"conditionOfConstruction\":\"functional\"").objects.size(), 2u);
}

TEST(CityJson, AMeasureMayHaveAUnit) {
  for (const auto& [text, metres] :
       {std::pair("12.5", 12.5), std::pair("\"12.5\"", 12.5),
        std::pair("{\"value\":10,\"uom\":\"ft\"}", 3.048), std::pair("{\"value\":7}", 7.0)}) {
    const City read = read_city(
        city_json(object("b", "Building", solid(),
                         "\"attributes\":{\"measuredHeight\":" + std::string(text) + "}")));
    EXPECT_NEAR(read.objects.at(0).measured_height_m.value(), metres, 1e-12) << text;
  }
}

TEST(CityJson, ATemplatesMatrixIsHomogeneousAndItsPlaceIsKept) {
  const std::string instance =
      "{\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[6],"
      "\"transformationMatrix\":[0,-4,0,0, 4,0,0,0, 0,0,4,1, 0,0,0,2]}";
  const City read = read_city(city_json(object("f", "CityFurniture", instance), unit_triangle));
  ASSERT_EQ(read.objects.at(0).polygons.size(), 1u);
  const city::Polygon& shape = read.objects[0].polygons[0];
  const city::Ring expected{{12, 23, 34.5}, {12, 25, 34.5}, {10, 23, 34.5}};
  for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(shape.exterior[i], expected[i]), 1e-12);
  EXPECT_EQ(shape.anchor, glm::dvec3(12, 23, 34));
}

TEST(CityJson, ExtensionsAreSkippedAndCounted) {
  const City read = read_city(city_json(
      object("n", "+NoiseBarrier", solid(), "\"children\":[\"p\"]") + "," +
          object("p", "BuildingPart", solid(), "\"parents\":[\"n\"]"),
      "\"extensions\":{\"Noise\":{\"url\":\"u\",\"version\":\"1\"}},\"+extra\":{\"a\":1}"));
  ASSERT_EQ(read.objects.size(), 1u) << "the part stands for itself";
  EXPECT_EQ(read.objects[0].id, "p");
  EXPECT_EQ(read.report.skipped.at("+NoiseBarrier"), 1u);
  EXPECT_EQ(read.report.skipped.at("polygon: of an extension's object"), 6u);
  EXPECT_EQ(read.report.skipped.at("extension"), 1u);
}

TEST(CityJson, ExtensionsOfKnownClassesAreReadAsThese) {
  const City read =
      read_city(city_json(object("g", "+GenericCityObject", solid()) + "," +
                          object("b", "+NoiseBuilding", solid(), "\"children\":[\"p\"]") + "," +
                          object("p", "+NoiseBuildingPart", solid(), "\"parents\":[\"b\"]")));
  ASSERT_EQ(read.objects.size(), 2u);
  EXPECT_EQ(read.objects[0].type, city::ObjectType::generic);
  EXPECT_EQ(read.objects[1].type, city::ObjectType::building);
  EXPECT_EQ(read.objects[1].class_name, "+NoiseBuilding");
}

TEST(CityJson, ATransformWithoutThreeNumbersIsRefusedAndAVersionMayBeANumber) {
  const auto city = [](const std::string& translate, const std::string& version) {
    return "{\"type\":\"CityJSON\",\"version\":" + version +
           ",\"transform\":{\"scale\":[1,1,1],\"translate\":" + translate +
           "},\"CityObjects\":{},\"vertices\":[]}";
  };
  EXPECT_NO_THROW(read_city(city("[1,2,3]", "2.0")));
  EXPECT_THROW(read_city(city("[1,2]", "\"2.0\"")), Error);
  EXPECT_THROW(read_city(city("[\"1\",\"2\",\"3\"]", "\"2.0\"")), Error);
  EXPECT_THROW(read_city(city("[1,2,3]", "3.0")), Error);
  EXPECT_THROW(
      read_city("{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":[],\"vertices\":[]}"),
      Error);
}

TEST(CityJson, AGeometryThatIsNoArrayIsCounted) {
  std::string text = city_json(object("a", "Building", solid()));
  const auto at = text.find("\"geometry\":[");
  ASSERT_NE(at, std::string::npos);
  const auto open = text.find('[', at);
  int depth = 0;
  std::size_t close = open;
  for (;; ++close) {
    depth += text[close] == '[' ? 1 : text[close] == ']' ? -1 : 0;
    if (depth == 0) break;
  }
  text[open] = ' ';
  text[close] = ' ';
  EXPECT_EQ(read_city(text).report.skipped.at("geometry that is no array"), 1u);
}

TEST(CityJson, TheHeadHasClosedRingsFromTheFirstObjects) {
  const TemporaryFile file(city_json(object("a", "Building", solid())), ".json");
  const city::CityHead head = read_cityjson_head(file.path());
  EXPECT_EQ(head.version, "2.0");
  ASSERT_EQ(head.sample.size(), 30u);
  EXPECT_EQ(head.sample[0], head.sample[4]);
  EXPECT_EQ(head.sample[0], glm::dvec3(10, 20, 30));
}

TEST(CityJson, ThreadsChangeNothing) {
  std::string objects;
  for (int i = 0; i < 3000; ++i)
    objects += (i ? "," : "") + object("b" + std::to_string(i), "Building", solid());
  const std::string text = city_json(objects);
  city::ReadOptions one, many;
  one.threads = 1;
  const City a = read_city(text, one), b = read_city(text, many);
  ASSERT_EQ(a.objects.size(), 3000u);
  ASSERT_EQ(b.objects.size(), 3000u);
  for (std::size_t i = 0; i < a.objects.size(); ++i) EXPECT_EQ(a.objects[i].id, b.objects[i].id);
}

// The oracle: the same building in both formats.
TEST(CityJson, GivesTheTrianglesOfTheSameBuildingInCityGml) {
  std::string gml_members, cj_objects;
  const std::string vertices = "[[0,0,0],[0,1,0],[1,1,0],[1,0,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]]";
  for (const std::string id : {"a", "b"}) {
    gml_members += member(
        building(id,
                 "<bldg:yearOfConstruction>1984</bldg:yearOfConstruction><bldg:measuredHeight>"
                 "7</bldg:measuredHeight><bldg:storeysAboveGround>2</bldg:storeysAboveGround>"));
    cj_objects += (cj_objects.empty() ? "" : ",") +
                  object(id, "Building",
                         "{\"type\":\"Solid\",\"lod\":\"2\",\"boundaries\":[[[[0,1,2,3]],"
                         "[[4,5,6,7]],[[0,3,5,4]]]]," +
                             box_semantics("[[0,1,2]]") + "}",
                         "\"attributes\":{\"yearOfConstruction\":\"1984\",\"measuredHeight\":7,"
                         "\"storeysAboveGround\":2}");
  }
  const TemporaryFile gml(city_model(gml_members));
  std::vector<city::CityObject> expected;
  citygml::read_citygml(gml.path(), {},
                        [&](city::CityObject&& o) { expected.push_back(std::move(o)); });
  const City read = read_city("{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{" +
                              cj_objects + "},\"vertices\":" + vertices + "}");
  ASSERT_EQ(read.objects.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const city::CityObject &a = read.objects[i], &b = expected[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.lod, b.lod);
    EXPECT_EQ(a.class_name, b.class_name);
    EXPECT_EQ(a.year, b.year);
    EXPECT_EQ(a.measured_height_m, b.measured_height_m);
    EXPECT_EQ(a.storeys_above_ground, b.storeys_above_ground);
    mesh::MeshReport report;
    const mesh::TriangleMesh x = mesh::triangulate(a, report), y = mesh::triangulate(b, report);
    EXPECT_EQ(x.positions, y.positions);
    ASSERT_EQ(x.triangles.size(), y.triangles.size());
    for (std::size_t t = 0; t < x.triangles.size(); ++t) {
      EXPECT_TRUE(std::equal(std::begin(x.triangles[t].vertex), std::end(x.triangles[t].vertex),
                             std::begin(y.triangles[t].vertex)));
      EXPECT_EQ(x.triangles[t].surface, y.triangles[t].surface);
    }
  }
}

}  // namespace
}  // namespace nightcity::cityjson
