// CityJSON as tools write it beyond the examples of the specification.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/tools/cityjson/read_text.h"
#include "tests/tools/cityjson/small_cityjson.h"
#include "tools/city/end_date.h"

namespace nightcity::cityjson {
namespace {

using namespace test;

City read_attributes(const std::string& type, const std::string& attributes) {
  return read_city(city_json(object("a", type, solid(), "\"attributes\":{" + attributes + "}") +
                             "," + object("b", "Building", solid())));
}

TEST(CityJsonProducers, WaterOfAFloodThatMayComeIsLeftOutAndCounted) {
  for (const char* attributes : {"\"class\":\"1140\"", "\"class\":[\"1140\"]",
                                 "\"uro:floodingRiskAttribute\":[{\"rank\":1}]"}) {
    const City city = read_attributes("WaterBody", attributes);
    ASSERT_EQ(city.objects.size(), 1u) << attributes;
    EXPECT_EQ(city.report.skipped.at(city::flood_object), 1u);
    EXPECT_EQ(city.report.skipped.at("polygon: of an object that is not there"), 6u);
  }
  const City river = read_attributes("WaterBody", "\"class\":\"1020\"");
  ASSERT_EQ(river.objects.size(), 2u);
  EXPECT_EQ(river.objects[0].building_class, "1020");
  EXPECT_EQ(read_attributes("Building", "\"class\":\"1140\"").objects.size(), 2u);
}

TEST(CityJsonProducers, WhatIsNotThereYetIsLeftOutAndCounted) {
  const City city = read_attributes("Building", "\"validFrom\":\"9998-01-01\"");
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.report.skipped.at(city::future_object), 1u);
  EXPECT_EQ(read_attributes("Building", "\"validFrom\":\"1998-01-01\"").objects.size(), 2u);
}

TEST(CityJsonProducers, AFootprintIsAsHighAsItsAttributesSay) {
  const std::string plan = "{\"type\":\"MultiSurface\",\"lod\":\"0\",\"boundaries\":[[[0,1,2,3]]]}";
  const auto height_of = [&](const std::string& attributes) {
    const City city =
        read_city(city_json(object("b", "Building", plan, "\"attributes\":{" + attributes + "}")));
    return city.objects.at(0).measured_height_m.value_or(0);
  };
  EXPECT_DOUBLE_EQ(height_of("\"height\":9"), 9);
  EXPECT_DOUBLE_EQ(height_of("\"Height\":{\"value\":30,\"uom\":\"ft\"}"), 9.144);
  EXPECT_DOUBLE_EQ(height_of("\"b3_h_dak_max\":12.5,\"b3_h_maaiveld\":0.5"), 12);
  EXPECT_DOUBLE_EQ(height_of("\"b3_h_dak_max\":12.5,\"b3_h_dak_70p\":10.5,\"b3_h_maaiveld\":0.5"),
                   10);
  EXPECT_DOUBLE_EQ(height_of("\"height\":9,\"measuredHeight\":7"), 7);
  EXPECT_DOUBLE_EQ(height_of("\"b3_h_dak_max\":12.5"), 0);
  EXPECT_DOUBLE_EQ(height_of("\"b3_h_dak_max\":null,\"b3_h_maaiveld\":0.5"), 0);
}

// Parent and child should name each other; some writers fill in one of the two.
TEST(CityJsonProducers, APartBelongsToTheParentThatItNames) {
  for (const char* said : {"\"parents\":[\"b\"]", "\"parent\":\"b\""}) {
    const std::string objects =
        object("p", "BuildingPart", solid(), said) + "," + object("b", "Building", "") + "," +
        object("q", "BuildingInstallation", solid("\"2\""), "\"parents\":[\"p\"]");
    for (const City& city :
         {read_city(city_json(objects)), read_city(header() + feature("b", objects))}) {
      ASSERT_EQ(city.objects.size(), 1u) << said;
      EXPECT_EQ(city.objects[0].id, "b");
      EXPECT_EQ(city.objects[0].lod, 2);
    }
  }
  const City alone =
      read_city(city_json(object("p", "BuildingPart", solid(), "\"parents\":[\"x\"]")));
  EXPECT_EQ(alone.objects.size(), 1u) << "its parent is in another file";
}

TEST(CityJsonProducers, ATransformThatIsNullIsNone) {
  std::string text = city_json(object("b", "Building", solid()), "", "1.1");
  text.replace(text.find(transform), std::string(transform).size(), "\"transform\":null");
  const City city = read_city(text);
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_DOUBLE_EQ(volume(city.objects[0]), 200.0 * 300 * 400);
}

// So was the CRS named before referenceSystem.
TEST(CityJsonProducers, ACrsMayBeACodeOfEpsg) {
  std::string text = city_json(object("b", "Building", solid()), "", "1.0");
  const std::string said = "\"referenceSystem\":\"https://www.opengis.net/def/crs/EPSG/0/7415\"";
  text.replace(text.find(said), said.size(), "\"crs\":{\"epsg\":7415}");
  EXPECT_EQ(read_city(text).report.srs_name, "EPSG:7415");
}

// RFC 7464: a control character before each value.
TEST(CityJsonProducers, ASequenceMayHaveRecordSeparators) {
  const std::string text = "\x1E" + header() + "\x1E" +
                           feature("a", object("a", "Building", solid())) + "\x1E" +
                           feature("b", object("b", "Building", solid()));
  EXPECT_TRUE(begins_as_cityjson(text));
  EXPECT_EQ(read_city(text).objects.size(), 2u);
}

// JSON leaves the order to the writer: the first 64 KiB may hold one long member.
TEST(CityJsonProducers, ACityIsRecognisedByWhateverItBeginsWith) {
  for (const char* start :
       {"{\"vertices\": [\n[1,2,3],", "{\"version\":\"2.0\",\"vertices\":[[1,2,3],",
        "{\"geometry-templates\":{\"templates\":[", "{ \"appearance\":{\"textures\":[",
        "{\"metadata\":{},\"type\" : \"CityJSON\",", "{\"CityObjects\":{"})
    EXPECT_TRUE(begins_as_cityjson(start)) << start;
  for (const char* start :
       {"{\"vertices\":[1,2,3,", "{\"features\":[{\"properties\":{\"appearance\":1},",
        "{\"type\":\"Topology\",\"transform\":{", "{\"vertices\":\"[[1\",",
        "[{\"vertices\":[[1,2,3],"})
    EXPECT_FALSE(begins_as_cityjson(start)) << start;
  std::string text = city_json(object("b", "Building", solid()));
  const std::string vertices = std::string("\"vertices\":") + box_vertices;
  text.erase(text.rfind(vertices) - 1, vertices.size() + 1);
  text.insert(1, vertices + std::string(100'000, ' ') + ",");
  EXPECT_NEAR(volume(read_city(text).objects.at(0)), 24, 1e-9);
}

TEST(CityJsonProducers, StoreysHaveOtherNamesAndHeightsTheirUnits) {
  const std::string plan = "{\"type\":\"MultiSurface\",\"lod\":\"0\",\"boundaries\":[[[0,1,2,3]]]}";
  for (const char* said : {"\"levels\":3", "\"Anzahl_Geschosse\":\"3\"", "\"height\":\"9 m\"",
                           "\"Hoehe\":\"9,0\"", "\"bouwlagen\":3.0"}) {
    const City city = read_city(
        city_json(object("b", "Building", plan, "\"attributes\":{" + std::string(said) + "}")));
    double top = 0;
    for (const city::Polygon& polygon : city.objects.at(0).polygons)
      for (const glm::dvec3& p : polygon.exterior) top = std::max(top, p.z);
    EXPECT_DOUBLE_EQ(top, 30 + 9) << said;
  }
}

TEST(CityJsonProducers, StoreysAreTheBuildingWhereItHasNothingElse) {
  const std::string storey = object("s", "BuildingStorey", solid(), "\"parents\":[\"b\"]");
  const std::string children = "\"children\":[\"s\"]";
  const City hollow = read_city(city_json(object("b", "Building", "", children) + "," + storey));
  ASSERT_EQ(hollow.objects.size(), 1u);
  EXPECT_NEAR(volume(hollow.objects[0]), 24, 1e-9);
  const City whole =
      read_city(city_json(object("b", "Building", solid(), children) + "," + storey));
  EXPECT_EQ(whole.objects.at(0).polygons.size(), 6u);
  EXPECT_EQ(whole.report.skipped.at("BuildingStorey"), 1u);
}

TEST(CityJsonProducers, AMatrixOfATemplateMayBeWrittenInColumns) {
  const std::string templates =
      "\"geometry-templates\":{\"templates\":[{\"type\":\"MultiSurface\",\"lod\":\"1\","
      "\"boundaries\":[[[0,1,2]]]}],\"vertices-templates\":[[0,0,0],[1,0,0],[0,1,0]]}";
  for (const char* matrix :
       {"1,0,0,5,0,1,0,6,0,0,1,7,0,0,0,1", "1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1"}) {
    const std::string placed =
        "{\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[0],"
        "\"transformationMatrix\":[" +
        std::string(matrix) + "]}";
    const City city = read_city(city_json(object("f", "CityFurniture", placed), templates));
    EXPECT_EQ(city.objects.at(0).polygons.at(0).exterior.at(0), glm::dvec3(15, 26, 37)) << matrix;
  }
}

TEST(CityJsonProducers, AFeatureMayHaveATransformOfItsOwn) {
  const City city =
      read_city(header() + feature("a", object("a", "Building", solid()),
                                   "\"transform\":{\"scale\":[1,1,1],\"translate\":[0,0,0]}"));
  EXPECT_NEAR(volume(city.objects.at(0)), 200.0 * 300 * 400, 1e-3);
}

TEST(CityJsonProducers, BoundariesOfAnotherTypeAreReadAsTheyAreNested) {
  const std::string faces = std::string("[") + box_faces + "]";
  struct Case {
    std::string type, boundaries;
  };
  for (const Case& c : {Case{"Solid", faces}, Case{"MultiSurface", "[" + faces + "]"},
                        Case{"MultiSolid", "[" + faces + "]"}, Case{"Solid", "[[" + faces + "]]"},
                        Case{"Solid", "[[],[" + faces + "]]"}}) {
    const City city = read_city(city_json(
        object("b", "Building",
               "{\"type\":\"" + c.type + "\",\"lod\":\"2\",\"boundaries\":" + c.boundaries + "}")));
    ASSERT_EQ(city.report.polygons, 6u) << c.type << c.boundaries;
    EXPECT_NEAR(volume(city.objects.at(0)), 24, 1e-9);
    EXPECT_EQ(city.report.skipped.at("type " + c.type + " of a geometry that is nested otherwise"),
              1u);
  }
}

// Python's json.dumps and C++ write them.
TEST(CityJsonProducers, NumbersThatAreNoneSayNothing) {
  for (const char* number : {"NaN", "-Infinity", "nan", "-nan(ind)", "inf"}) {
    const std::string attributes = "\"attributes\":{\"a\":" + std::string(number) +
                                   ",\"b\":\"NaN \\\" NaN\",\"measuredHeight\":" + number + "}";
    const City city = read_city(city_json(object("x", "Building", solid(), attributes)));
    ASSERT_EQ(city.objects.size(), 1u) << number;
    EXPECT_NEAR(volume(city.objects[0]), 24, 1e-9);
    EXPECT_FALSE(city.objects[0].measured_height_m);
    const City lines =
        read_city(header() + feature("x", object("x", "Building", solid(), attributes)));
    EXPECT_EQ(lines.report.polygons, 6u) << number;
  }
  std::string text = city_json(object("x", "Building", solid()));
  text.replace(text.find("[0,0,0]"), 7, "[0,0,NaN]");
  EXPECT_EQ(read_city(text).report.skipped.at("polygon: ring with coordinates that are no numbers"),
            3u);
  EXPECT_NE(error_of(city_json(object("x", "Building", solid(), "\"attributes\":{\"a\":NaX}")))
                .find("not JSON"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity::cityjson
