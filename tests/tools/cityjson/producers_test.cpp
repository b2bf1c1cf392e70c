// CityJSON as tools write it beyond the examples of the specification.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace nightcity::cityjson
