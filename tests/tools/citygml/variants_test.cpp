// Valid and common ways of writing a city that differ from the usual one: curves, blanks in links,
// control points, footprints with a height, classes of extensions, UTF-16, heights that are none.
#include <gtest/gtest.h>
#include <zip.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/data.h"
#include "support/make_png.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/read_file.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/city/ring.h"
#include "tools/city/text_encoding.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

using namespace test;

std::string building_of(const std::string& content) {
  return "<bldg:Building gml:id=\"A\">" + content + "</bldg:Building>";
}

std::string lod2(const std::string& members) {
  return "<bldg:lod2MultiSurface>" + multi_surface(members) + "</bldg:lod2MultiSurface>";
}

std::string curve_polygon(const std::string& members) {
  return surface_member("<gml:Polygon><gml:exterior><gml:Ring>" + members +
                        "</gml:Ring></gml:exterior></gml:Polygon>");
}

std::string curve(const std::string& segments) {
  return "<gml:curveMember><gml:Curve><gml:segments>" + segments +
         "</gml:segments></gml:Curve></gml:curveMember>";
}

std::string pos_list(const std::string& numbers) {
  return "<gml:posList>" + numbers + "</gml:posList>";
}

double area_of(const city::Polygon& polygon) {
  return glm::length(city::area_vector(polygon.exterior));
}

TEST(Variants, RingsOfCurvesAreRead) {
  const std::string line = "<gml:LineStringSegment>" +
                           pos_list("0 0 8 10 0 8 10 10 8 0 10 8 0 0 8") +
                           "</gml:LineStringSegment>";
  const std::string strings =
      "<gml:curveMember><gml:LineString>" + pos_list("0 0 5 9 0 5") +
      "</gml:LineString></gml:curveMember><gml:curveMember><gml:OrientableCurve orientation=\"-\">"
      "<gml:baseCurve><gml:LineString>" +
      pos_list("0 0 5 0 10 5 9 10 5 9 0 5") +
      "</gml:LineString></gml:baseCurve></gml:OrientableCurve></gml:curveMember>";
  const std::string arcs = "<gml:Arc>" + pos_list("45 0 8 40 5 8 35 0 8") + "</gml:Arc><gml:Arc>" +
                           pos_list("35 0 8 40 -5 8 45 0 8") + "</gml:Arc>";
  const std::string circle = "<gml:Circle>" + pos_list("5 0 0 0 5 0 0 -5 0") + "</gml:Circle>";
  const City city =
      read_member(building_of(lod2(curve_polygon(curve(line)) + curve_polygon(strings) +
                                   curve_polygon(curve(arcs)) + curve_polygon(curve(circle)))));
  ASSERT_EQ(city.objects.at(0).polygons.size(), 4u);
  const double disc = 25 * std::numbers::pi;
  EXPECT_NEAR(area_of(city.objects[0].polygons[0]), 100, 1e-9);
  EXPECT_NEAR(area_of(city.objects[0].polygons[1]), 90, 1e-9);
  EXPECT_NEAR(area_of(city.objects[0].polygons[2]), disc, 0.001 * disc);
  EXPECT_NEAR(area_of(city.objects[0].polygons[3]), disc, 0.001 * disc);
  EXPECT_TRUE(city.report.skipped.empty());
}

TEST(Variants, CurvesThatAreNotReadAreCountedAsSuch) {
  const City city = read_member(building_of(lod2(
      curve_polygon(curve("<gml:BSpline>" + pos_list("0 0 0 1 0 0 1 1 0") + "</gml:BSpline>")) +
      curve_polygon("<gml:curveMember xlink:href=\"#c\"/>"))));
  ASSERT_EQ(city.report.skipped.size(), 1u);
  EXPECT_NE(city.report.skipped.begin()->first.find("curves that are not read"), std::string::npos);
  EXPECT_EQ(city.report.skipped.begin()->second, 2u);
}

TEST(Variants, AHeadOfCurvesOrPointsHasASample) {
  const TemporaryFile curves(city_model(member(building_of(
      lod2(curve_polygon(curve("<gml:LineStringSegment>" + pos_list("0 0 8 10 0 8 10 10 8") +
                               "</gml:LineStringSegment>")))))));
  EXPECT_EQ(read_citygml_head(curves.path()).sample.size(), 4u);
  const TemporaryFile points(city_model(
      member("<dem:MassPointRelief><dem:reliefPoints><gml:MultiPoint><gml:pointMember><gml:Point><"
             "gml:pos>1 2 "
             "3</gml:pos></gml:Point></gml:pointMember></gml:MultiPoint></dem:reliefPoints>"
             "</dem:MassPointRelief>")));
  ASSERT_EQ(read_citygml_head(points.path()).sample.size(), 1u);
  EXPECT_EQ(read_citygml_head(points.path()).sample[0], glm::dvec3(1, 2, 3));
}

TEST(Variants, BlanksInLinksCollapse) {
  const City city = read_member(building_of(
      "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>"
      "<gml:surfaceMember xlink:href=\" #  q \n\"/></gml:CompositeSurface></gml:exterior>"
      "</gml:Solid></bldg:lod2Solid>" +
      boundary("RoofSurface", surface_member(polygon(" q", square_at_one)))));
  EXPECT_EQ(city.objects.at(0).polygons.size(), 1u);
  EXPECT_TRUE(city.report.warnings.empty());
}

std::string tin_relief(const std::string& patches) {
  return "<dem:TINRelief gml:id=\"T\"><dem:lod>2</dem:lod><dem:tin><gml:Tin><gml:trianglePatches>" +
         patches + "</gml:trianglePatches><gml:controlPoint>" +
         pos_list("0 0 1 5 0 2 0 5 3 5 5 4") +
         "</gml:controlPoint></gml:Tin></dem:tin></dem:TINRelief>";
}

TEST(Variants, ControlPointsOfATinWithoutTrianglesAreItsPoints) {
  const City points = read_member(tin_relief(""));
  ASSERT_EQ(points.objects.at(0).points.size(), 4u);
  EXPECT_EQ(points.objects[0].points[3], glm::dvec3(5, 5, 4));
  const City triangles =
      read_member(tin_relief("<gml:Triangle><gml:exterior>" + ring("0 0 1 5 0 2 0 5 3 0 0 1") +
                             "</gml:exterior></gml:Triangle>"));
  EXPECT_EQ(triangles.objects.at(0).polygons.size(), 1u);
  EXPECT_TRUE(triangles.objects[0].points.empty());
}

std::string flat(const std::string& property, const std::string& numbers,
                 const std::string& height) {
  return building_of(height + "<bldg:" + property + ">" +
                     multi_surface(surface_member(polygon("p", numbers))) + "</bldg:" + property +
                     ">");
}

TEST(Variants, FootprintsWithAHeightBecomeBlocks) {
  const std::string height = "<bldg:measuredHeight>9</bldg:measuredHeight>";
  struct Case {
    const char* property;
    const char* numbers;
    double foot, top;
  };
  for (const Case& c :
       {Case{"lod0RoofEdge", "0 0 0 9 0 0 9 8 0 0 8 0 0 0 0", 0, 9},  // no heights in the file
        Case{"lod0RoofEdge", "0 0 50 9 0 50 9 8 50 0 8 50 0 0 50", 41, 50},
        Case{"lod0FootPrint", "0 0 50 0 8 50 9 8 50 9 0 50 0 0 50", 50, 59}}) {
    const City city = read_member(flat(c.property, c.numbers, height));
    const city::CityObject& block = city.objects.at(0);
    ASSERT_EQ(block.polygons.size(), 6u);
    EXPECT_EQ(block.polygons[0].surface, city::SurfaceType::ground);
    EXPECT_EQ(block.polygons[0].exterior[0].z, c.foot);
    EXPECT_LT(city::area_vector(block.polygons[0].exterior).z, 0);
    EXPECT_EQ(block.polygons[1].surface, city::SurfaceType::roof);
    EXPECT_EQ(block.polygons[1].exterior[0].z, c.top);
    glm::dvec3 sum{0};
    for (const city::Polygon& p : block.polygons) sum += city::area_vector(p.exterior);
    EXPECT_NEAR(glm::length(sum), 0, 1e-9) << "a closed shell";
    EXPECT_EQ(city.report.extruded, 1u);
    EXPECT_EQ(city.report.warnings.size(), 1u);
  }
  const City sheet = read_member(flat("lod0FootPrint", "0 0 5 9 0 5 9 8 5 0 0 5", ""));
  EXPECT_EQ(sheet.objects.at(0).polygons.size(), 1u);
  EXPECT_EQ(sheet.report.flat, 1u);
}

TEST(Variants, HeightsThatStandForNoneAreLeftOutAndCounted) {
  for (const char* numbers :
       {"0 0 -9999 1 0 -9999 1 1 -9999 0 0 -9999", "0 0 -9999 1 0 -9999 1 1 -9980 0 0 -9999",
        "0 0 -3.4e38 1 0 0 1 1 0 0 0 -3.4e38"}) {
    const City city = read_member(building_of(
        lod2(surface_member(polygon("p", numbers)) + surface_member(polygon("q", square_at_one)))));
    EXPECT_EQ(city.objects.at(0).polygons.size(), 1u);
    ASSERT_EQ(city.report.skipped.size(), 1u);
    EXPECT_EQ(city.report.skipped.begin()->second, 1u);
  }
}

TEST(Variants, ClassesOfExtensionsStandForThoseTheyDeriveFrom) {
  const City city = read_member(
      "<uro:UndergroundBuilding xmlns:uro=\"u\" gml:id=\"U\"><bldg:boundedBy><uro:GreenRoofSurface>"
      "<bldg:lod2MultiSurface>" +
      multi_surface(surface_member(polygon("a", square_at_one))) +
      "</bldg:lod2MultiSurface></uro:GreenRoofSurface></bldg:boundedBy><bldg:boundedBy><uro:Skin>"
      "<bldg:lod2MultiSurface>" +
      multi_surface(surface_member(polygon("b", square_at_zero))) +
      "</bldg:lod2MultiSurface></uro:Skin></bldg:boundedBy></uro:UndergroundBuilding>");
  const city::CityObject& object = city.objects.at(0);
  EXPECT_EQ(object.type, city::ObjectType::building);
  EXPECT_EQ(object.class_name, "UndergroundBuilding");
  ASSERT_EQ(object.polygons.size(), 2u);
  EXPECT_EQ(object.polygons[0].surface, city::SurfaceType::roof);
  EXPECT_EQ(object.polygons[1].surface, city::SurfaceType::unknown);
}

TEST(Variants, AGeometrysOwnCrsWinsOverTheEnvelopes) {
  std::string text = city_model(member(building("A")));
  const std::string solid = "<gml:Solid>";
  text.replace(text.find(solid), solid.size(), "<gml:Solid srsName=\" EPSG:31467 \">");
  EXPECT_EQ(read_citygml_head(TemporaryFile(text).path()).srs_name, "EPSG:31467");
}

// Returns a flat roof whose Polygon and whose extent name these CRSs; "" = none.
std::string named_roof(const std::string& id, const std::string& own, const std::string& extent) {
  const auto attribute = [](const std::string& name) {
    return name.empty() ? "" : " srsName=\"" + name + "\"";
  };
  std::string text = polygon("", square_at_one);
  text.replace(0, 12, "<gml:Polygon" + attribute(own));
  const std::string box =
      extent.empty() ? ""
                     : "<gml:boundedBy><gml:Envelope" + attribute(extent) +
                           "><gml:lowerCorner>0 0 0</gml:lowerCorner><gml:upperCorner>1 1 1"
                           "</gml:upperCorner></gml:Envelope></gml:boundedBy>";
  return member("<bldg:Building gml:id=\"" + id + "\">" + box +
                boundary("RoofSurface", surface_member(text)) + "</bldg:Building>");
}

TEST(Variants, EachGeometryTellsTheCrsThatHoldsForIt) {
  const TemporaryFile file(city_model(
      named_roof("first", "EPSG:31467", "") + named_roof("documents", "", "") +
      named_roof("features", "", "EPSG:4326") + named_roof("own", "EPSG:31468", "EPSG:4326") +
      named_roof("as first", " EPSG:31467 ", "EPSG:4326")));
  EXPECT_EQ(read_citygml_head(file.path()).srs_name, "EPSG:31467");
  EXPECT_EQ(read_citygml_head(file.path()).sample.size(), 10u) << "of two roofs of that CRS";
  city::ReadOptions options;
  options.srs_name = "EPSG:31467";
  const City city = read_file(file.path(), options);
  ASSERT_EQ(city.objects.size(), 5u);
  const auto name = [&](std::size_t i) {
    const auto& said = city.objects[i].polygons.at(0).srs_name;
    return said ? *said : "the file's";
  };
  EXPECT_EQ(name(0), "the file's");
  EXPECT_EQ(name(1), "EPSG:25833") << "the document's extent";
  EXPECT_EQ(name(2), "EPSG:4326");
  EXPECT_EQ(name(3), "EPSG:31468");
  EXPECT_EQ(name(4), "the file's");
  options.reader = city::Reader::libcitygml;
  const City second = read_file(file.path(), options);
  EXPECT_EQ(second.objects.size(), 2u) << "libcitygml does not tell names: others are left out";
  EXPECT_EQ(second.report.skipped.at("bldg:Building"), 3u);
}

TEST(Variants, LinkedGeometryKeepsTheCrsOfThePlaceWhereItStands) {
  std::string roof = named_roof("holder", "EPSG:31468", "");
  roof.replace(roof.find("<gml:Polygon"), 12, "<gml:Polygon gml:id=\"shared\"");
  const std::string link =
      member("<bldg:Building gml:id=\"user\">" + boundary("RoofSurface", xlink_member("shared")) +
             "</bldg:Building>");
  city::ReadOptions options;
  options.srs_name = "EPSG:25833";
  const City city = read_file(TemporaryFile(city_model(roof + link)).path(), options);
  ASSERT_EQ(city.objects.size(), 2u);
  for (const city::CityObject& object : city.objects) {
    ASSERT_TRUE(object.polygons.at(0).srs_name) << object.id;
    EXPECT_EQ(*object.polygons[0].srs_name, "EPSG:31468");
  }
}

std::string to_utf16(const std::string& text, bool big_endian, bool mark) {
  std::string out;
  const auto put = [&](char16_t unit) {
    const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
    out += big_endian ? high : low;
    out += big_endian ? low : high;
  };
  if (mark) put(0xFEFF);
  for (const char c : text) put(static_cast<char16_t>(c));
  return out;
}

TEST(Variants, Utf16IsRead) {
  const std::string text = city_model(member(building("A")));
  for (const bool big_endian : {false, true})
    for (const bool mark : {false, true}) {
      const City city = read_file(TemporaryFile(to_utf16(text, big_endian, mark)).path());
      ASSERT_EQ(city.objects.size(), 1u);
      EXPECT_EQ(city.objects[0].id, "A");
      EXPECT_EQ(city.report.polygons, 3u);
    }
}

TEST(Variants, TextsAreValidUtf8WhateverTheFileHolds) {
  const City city = read_member(
      "<bldg:Building gml:id=\"A\xFF\xC3\x28\"><bldg:function>\xE2\x82"
      "</bldg:function></bldg:Building>");
  EXPECT_EQ(city.objects.at(0).id, "A\uFFFD\uFFFD(");
  EXPECT_EQ(city.objects[0].function, "\uFFFD\uFFFD");
  EXPECT_EQ(city::to_valid_utf8("\xED\xA0\x80 \xC0\xAF \xF4\x90\x80\x80 \u20AC"),
            "\uFFFD\uFFFD\uFFFD \uFFFD\uFFFD \uFFFD\uFFFD\uFFFD\uFFFD \u20AC");
}

void write_zip(const std::filesystem::path& path,
               const std::vector<std::pair<std::string, std::string>>& files) {
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [name, text] : files)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0),
                 ZIP_FL_ENC_UTF_8);
  ASSERT_EQ(zip_close(archive), 0);
}

TEST(Variants, MetadataAndCodeListsInAnArchiveArePassedOverWithANote) {
  const TemporaryFile file("", ".zip");
  const std::string text = city_model(member(building("A")));
  const std::string metadata = "<?xml version=\"1.0\"?><metadata><title>t</title></metadata>";
  const std::string codes =
      "<gml:Dictionary xmlns:gml=\"g\"><gml:name>n</gml:name></gml:Dictionary>";
  write_zip(file.path(),
            {{"a/meta.xml", metadata}, {"codelists/c.xml", codes}, {"udx/b.gml", text}});
  const City city = read_file(file.path());
  EXPECT_EQ(city.objects.size(), 1u);
  ASSERT_EQ(city.report.warnings.size(), 2u);
  EXPECT_NE(city.report.warnings[0].find("a/meta.xml"), std::string::npos);
  EXPECT_NE(city.report.warnings[0].find("<metadata>"), std::string::npos);
  EXPECT_EQ(read_citygml_head(file.path()).srs_name, "EPSG:25833");
  const TemporaryFile none("", ".zip");
  write_zip(none.path(), {{"meta.xml", metadata}, {"codes.xml", codes}});
  EXPECT_THROW(read_file(none.path()), Error);
}

TEST(Variants, TexturesGiveTheirMeanOnRequest) {
  const TempFolder folder;
  // The left half is black, the right half white.
  write_text(folder / "half.png", make_rgb_png(4, 2, [](std::size_t x, std::size_t) {
               const unsigned char v = x < 2 ? 0 : 255;
               return std::array<unsigned char, 3>{v, v, v};
             }));
  const auto texture = [](const std::string& uri, const std::string& target, double left) {
    const std::string l = std::to_string(left), r = std::to_string(left + 0.5);
    return "<app:surfaceDataMember><app:ParameterizedTexture><app:imageURI>" + uri +
           "</app:imageURI><app:target uri=\"#" + target +
           "\"><app:TexCoordList><app:textureCoordinates ring=\"#r\">" + l + " 0 " + r + " 0 " + r +
           " 1 " + l +
           " 0</app:textureCoordinates></app:TexCoordList></app:target>"
           "</app:ParameterizedTexture></app:surfaceDataMember>";
  };
  const std::string text = city_model(
      member(building("A", "<app:appearance><app:Appearance>" + texture("half.png", "A_r", 0.5) +
                               "</app:Appearance></app:appearance>")) +
      "<app:appearanceMember><app:Appearance>" + texture("half.png", "A_w", 0) +
      texture("../half.png", "A_g", 0) + texture("none.png", "A_g", 0) +
      texture("city.gml", "A_g", 0) + "</app:Appearance></app:appearanceMember>");
  write_text(folder / "city.gml", text);
  const auto colour_of = [](const City& city, const std::string& id) {
    for (const city::Polygon& polygon : city.objects.at(0).polygons)
      if (polygon.id == id) return polygon.diffuse_colour;
    return std::optional<glm::vec3>();
  };
  const City without = read_file(folder / "city.gml");
  EXPECT_FALSE(colour_of(without, "A_r"));
  EXPECT_EQ(without.report.skipped.at("app:ParameterizedTexture"), 5u);
  city::ReadOptions options;
  options.textures = city::Textures::mean;
  const City city = read_file(folder / "city.gml", options);
  EXPECT_EQ(colour_of(city, "A_r"), glm::vec3(1));
  EXPECT_EQ(colour_of(city, "A_w"), glm::vec3(0));
  EXPECT_FALSE(colour_of(city, "A_g"));
  EXPECT_EQ(city.report.skipped.at("texture: its picture lies elsewhere"), 1u);
  EXPECT_EQ(city.report.skipped.at("texture: its picture is not there"), 1u);
  EXPECT_EQ(city.report.skipped.at("texture: its picture is no JPEG or PNG, or too large"), 1u);
  ASSERT_EQ(city.report.warnings.size(), 1u);
  EXPECT_NE(city.report.warnings[0].find("2 surfaces have the mean colour of their pictures"),
            std::string::npos)
      << city.report.warnings[0];
}

TEST(Variants, ARealCityHasTheColoursOfItsPictures) {
  REAL_DATA(file, "berlin/textured/export.gml");
  city::ReadOptions options;
  options.textures = city::Textures::mean;
  const City city = read_file(file, options);
  std::size_t coloured = 0, polygons = 0;
  for (const city::CityObject& object : city.objects)
    for (const city::Polygon& polygon : object.polygons)
      ++polygons, coloured += polygon.diffuse_colour.has_value();
  EXPECT_GT(coloured, 100u);
  EXPECT_LE(coloured, polygons);
}

}  // namespace
}  // namespace nightcity::citygml
