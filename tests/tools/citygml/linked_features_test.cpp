// Objects whose parts, surfaces and installations stand elsewhere, and are linked to.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/read_file.h"

namespace nightcity::citygml {
namespace {

using namespace test;

std::string link(const std::string& property, const std::string& target) {
  return "<bldg:" + property + " xlink:href=\"" + target + "\"/>";
}

std::string house(const std::string& id, const std::string& inside) {
  return member("<bldg:Building gml:id=\"" + id + "\">" + inside + "</bldg:Building>");
}

std::string feature(const std::string& kind, const std::string& id, const std::string& outline,
                    const std::string& inside = "") {
  return "<bldg:" + kind + " gml:id=\"" + id + "\">" + inside + "<bldg:lod2MultiSurface>" +
         multi_surface(surface_member(polygon(id + "_p", outline))) + "</bldg:lod2MultiSurface>" +
         "</bldg:" + kind + ">";
}

std::string roof() {
  return feature("BuildingPart", "part", square_at_one);
}

bool has_link_count(const City& city) {
  for (const auto& [what, count] : city.report.skipped)
    if (what.starts_with("xlink")) return true;
  return false;
}

TEST(LinkedFeatures, APartThatIsAMemberIsThatOfItsBuildingAlone) {
  const std::string whole = house("b", link("consistsOfBuildingPart", "#part"));
  for (const std::string& text : {whole + member(roof()), member(roof()) + whole}) {
    const City city = read(city_model(text));
    ASSERT_EQ(city.objects.size(), 1u);
    EXPECT_EQ(city.objects[0].id, "b");
    EXPECT_EQ(city.objects[0].polygons.size(), 1u);
    EXPECT_EQ(city.report.objects, 1u);
    EXPECT_FALSE(has_link_count(city));
  }
}

TEST(LinkedFeatures, EachKindOfPropertyIsFollowed) {
  const struct {
    const char *property, *kind;
    city::SurfaceType surface;
  } kinds[] = {
      {"boundedBy", "RoofSurface", city::SurfaceType::roof},
      {"boundedBy", "WallSurface", city::SurfaceType::wall},
      {"outerBuildingInstallation", "BuildingInstallation", city::SurfaceType::unknown},
      {"consistsOfBuildingPart", "BuildingPart", city::SurfaceType::unknown},
  };
  for (const auto& [property, kind, surface] : kinds) {
    const City city = read(
        city_model(house("b", link(property, "#x")) + member(feature(kind, "x", square_at_one))));
    ASSERT_EQ(city.objects.size(), 1u) << kind;
    ASSERT_EQ(city.objects[0].polygons.size(), 1u) << kind;
    EXPECT_EQ(city.objects[0].polygons[0].surface, surface) << kind;
  }
  const City city = read(
      city_model(house("b", "<bldg:boundedBy>" +
                                feature("WallSurface", "w", south_wall, link("opening", "#o")) +
                                "</bldg:boundedBy>") +
                 member(feature("Window", "o", square_at_one))));
  ASSERT_EQ(city.objects.size(), 1u);
  ASSERT_EQ(city.objects[0].polygons.size(), 2u);
  EXPECT_EQ(city.objects[0].polygons[0].surface, city::SurfaceType::window);
}

TEST(LinkedFeatures, LinksLeadOnFromWhatIsLinked) {
  const std::string part = feature("BuildingPart", "part", square_at_one, link("boundedBy", "#w"));
  const City city = read(city_model(member(part) + member(feature("WallSurface", "w", south_wall)) +
                                    house("b", link("consistsOfBuildingPart", "#part"))));
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons.size(), 2u);
}

TEST(LinkedFeatures, WhatSeveralLinkToIsDrawnOnce) {
  const City city =
      read(city_model(house("a", link("boundedBy", "#w")) + house("b", link("boundedBy", "#w")) +
                      member(feature("WallSurface", "w", south_wall))));
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[0].polygons.size() + city.objects[1].polygons.size(), 1u);
  EXPECT_FALSE(has_link_count(city));
}

TEST(LinkedFeatures, CyclesAndLonePartsStandForThemselves) {
  const auto part = [](const std::string& id, const std::string& other) {
    return member(
        feature("BuildingPart", id, square_at_one, link("consistsOfBuildingPart", "#" + other)));
  };
  EXPECT_EQ(read(city_model(part("a", "b") + part("b", "a"))).objects.size(), 2u);
  EXPECT_EQ(read(city_model(part("a", "a"))).objects.size(), 1u);
  EXPECT_EQ(read(city_model(member(roof()))).objects.size(), 1u);
}

TEST(LinkedFeatures, LinksToWhatTheMemberHoldsAndToNothing) {
  const City held =
      read(city_model(house("b", "<bldg:boundedBy>" + feature("WallSurface", "w", south_wall) +
                                     "</bldg:boundedBy>" + link("boundedBy", "#w"))));
  ASSERT_EQ(held.objects.size(), 1u);
  EXPECT_EQ(held.objects[0].polygons.size(), 1u);
  EXPECT_FALSE(has_link_count(held));
  const City none = read(city_model(house("b", link("boundedBy", "#none"))));
  EXPECT_EQ(none.report.skipped.at("xlink: bldg:boundedBy"), 1u);
}

TEST(LinkedFeatures, AddressesAreFollowed) {
  const std::string address =
      "<core:Address gml:id=\"x\"><core:xalAddress><xAL:ThoroughfareName>Main St"
      "</xAL:ThoroughfareName></core:xalAddress></core:Address>";
  const City city = read(city_model(house("a", link("address", "#x")) +
                                    house("b", link("address", "#x")) + member(address)));
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[0].address, "Main St");
  EXPECT_EQ(city.objects[1].address, "Main St");
}

// Copies of one part for each building would make a small file cost much.
TEST(LinkedFeatures, AreBoundByTheLimitOfLinks) {
  city::ReadOptions options;
  options.max_linked_vertices = 1;
  const City city = read(
      city_model(house("b", link("consistsOfBuildingPart", "#part")) + member(roof())), options);
  EXPECT_EQ(city.objects.size(), 2u);
  ASSERT_FALSE(city.report.warnings.empty());
  EXPECT_NE(city.report.warnings[0].find("max_linked_vertices"), std::string::npos);
}

TEST(LinkedFeatures, OfOtherFilesAndOfOtherDocumentsOfAnArchive) {
  const TempFolder folder;
  const std::string whole = city_model(house("b", link("consistsOfBuildingPart", "p.gml#part")));
  const std::string parts = city_model(member(roof()));
  write_text(folder / "b.gml", whole);
  write_text(folder / "p.gml", parts);
  city::ReadOptions options;
  options.neighbours = std::make_shared<const std::set<std::filesystem::path>>(
      std::set{folder / "b.gml", folder / "p.gml"});
  const City plain = read_file(folder / "b.gml", options);
  ASSERT_EQ(plain.objects.size(), 1u);
  EXPECT_EQ(plain.objects[0].polygons.size(), 1u);
  EXPECT_EQ(plain.objects[0].joined_ids, std::vector<std::string>{"part"});
  pack_zip(folder / "all.zip", {{"d/b.gml", whole}, {"d/p.gml", parts}});
  const City packed = read_file(folder / "all.zip");
  ASSERT_EQ(packed.objects.size(), 2u) << "the city leaves the part out";
  EXPECT_EQ(packed.find("b")->polygons.size(), 1u);
}

}  // namespace
}  // namespace nightcity::citygml
