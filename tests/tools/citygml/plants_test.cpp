// Plants of CityGML 1, 2 and 3: their attributes and the places where they stand.
#include <gtest/gtest.h>

#include <string>

#include "tests/tools/citygml/read_file.h"

namespace nightcity::citygml {
namespace {

using namespace test;

std::string plant_of(const std::string& id, const std::string& content) {
  return member("<veg:SolitaryVegetationObject gml:id=\"" + id + "\">" + content +
                "</veg:SolitaryVegetationObject>");
}

std::string city_of(const std::string& members, const std::string& version = "2.0") {
  std::string text = city_model(members, version);
  const std::string name =
      " xmlns:veg=\"http://www.opengis.net/citygml/vegetation/" + version + '"';
  return text.insert(text.find(" xmlns:gml"), name);
}

std::string point(const std::string& place) {
  return "<gml:Point><gml:pos>" + place + "</gml:pos></gml:Point>";
}

std::string implicit(const std::string& property, const std::string& more) {
  return "<" + property +
         "><core:ImplicitGeometry>"
         "<core:transformationMatrix>2 0 0 1 0 2 0 0 0 0 2 5 0 0 0 1</core:transformationMatrix>" +
         more + "<core:referencePoint>" + point("1000 2000 30") +
         "</core:referencePoint></core:ImplicitGeometry></" + property + ">";
}

TEST(Plants, AttributesOfEveryVersionAreReadInMetres) {
  for (const char* version : {"1.0", "2.0", "3.0"}) {
    SCOPED_TRACE(version);
    const City city =
        read(city_of(plant_of("t",
                              "<veg:class>1070</veg:class><veg:species>Tilia cordata</veg:species>"
                              "<veg:height uom=\"ft\">50</veg:height>"
                              "<veg:trunkDiameter uom=\"cm\">40</veg:trunkDiameter>"
                              "<veg:crownDiameter uom=\"m\">-8</veg:crownDiameter>"),
                     version));
    ASSERT_EQ(city.objects.size(), 1u);
    const city::CityObject& tree = city.objects[0];
    ASSERT_TRUE(tree.plant);
    EXPECT_EQ(tree.building_class, "1070");
    EXPECT_EQ(tree.plant->species, "Tilia cordata");
    EXPECT_DOUBLE_EQ(tree.plant->height_m.value(), 15.24);
    EXPECT_DOUBLE_EQ(tree.plant->trunk_m.value(), 0.4);
    EXPECT_FALSE(tree.plant->crown_m);
    EXPECT_EQ(tree.plant->odd_sizes, 1);
    EXPECT_FALSE(tree.measured_height_m);
  }
}

TEST(Plants, AnImplicitGeometryStandsWhereItPutsItsOrigin) {
  const std::string shape = "<core:relativeGMLGeometry>" +
                            multi_surface(surface_member(polygon("", "0 0 0 1 0 0 1 0 4 0 0 0"))) +
                            "</core:relativeGMLGeometry>";
  for (const std::string& more : {std::string(), shape}) {
    const City city =
        read(city_of(plant_of("t", implicit("veg:lod2ImplicitRepresentation", more))));
    ASSERT_EQ(city.objects.size(), 1u);
    ASSERT_EQ(city.objects[0].points.size(), 1u);
    EXPECT_EQ(city.objects[0].points[0], glm::dvec3(1001, 2000, 35));
    EXPECT_EQ(city.objects[0].polygons.size(), more.empty() ? 0u : 1u);
  }
}

TEST(Plants, APointIsAPlace) {
  const std::string points[] = {"<veg:lod1Geometry>" + point("7 8 9") + "</veg:lod1Geometry>",
                                "<core:lod0Point>" + point("7 8 9") + "</core:lod0Point>",
                                "<veg:lod1Geometry><gml:MultiPoint><gml:pointMember>" +
                                    point("7 8 9") +
                                    "</gml:pointMember></gml:MultiPoint></veg:lod1Geometry>"};
  for (const std::string& each : points) {
    const City city = read(city_of(plant_of("t", each)));
    ASSERT_EQ(city.objects.size(), 1u) << each;
    ASSERT_EQ(city.objects[0].points.size(), 1u) << each;
    EXPECT_EQ(city.objects[0].points[0], glm::dvec3(7, 8, 9));
    EXPECT_TRUE(city.report.skipped.empty()) << each;
  }
}

TEST(Plants, OtherObjectsDoNotTakePlaces) {
  const City city = read(
      city_of(plant_of("t", "<veg:lod1Geometry>" + point("7 8 9") + "</veg:lod1Geometry>") +
              member("<frn:CityFurniture gml:id=\"f\">" +
                     implicit("frn:lod2ImplicitRepresentation", "") + "</frn:CityFurniture>")));
  ASSERT_NE(city.find("f"), nullptr);
  EXPECT_TRUE(city.find("f")->points.empty());
  EXPECT_FALSE(city.find("f")->plant);
}

}  // namespace
}  // namespace nightcity::citygml
