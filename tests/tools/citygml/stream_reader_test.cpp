// Features of the stream reader alone: links across the file, every version, implicit geometry,
// materials, bounded memory.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/pack_zip.h"
#include "tests/tools/citygml/read_file.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

using namespace test;

std::string lod2_solid(const std::string& members) {
  return "<bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid>";
}

std::string building_of(const std::string& id, const std::string& content) {
  return "<bldg:Building gml:id=\"" + id + "\">" + content + "</bldg:Building>";
}

std::string numbered(std::string prefix, int number) {
  prefix += std::to_string(number);
  return prefix;
}

void pack_gzip(const std::filesystem::path& path, const std::string& text) {
  const gzFile out = gzopen(path.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
}

glm::dvec3 area(const city::Ring& ring) {
  glm::dvec3 sum{0};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return 0.5 * sum;
}

TEST(StreamReader, XlinkToAPolygonOfAnotherMemberIsFollowedInBothDirections) {
  const std::string owner = building_of(
      "owner", boundary("RoofSurface", surface_member(polygon("shared", square_at_one))));
  const std::string user = building_of("user", lod2_solid(xlink_member("shared")));
  for (const std::string& text :
       {city_model(member(user) + member(owner)), city_model(member(owner) + member(user))}) {
    const City city = read(text);
    ASSERT_EQ(city.objects.size(), 2u);
    ASSERT_NE(city.find("user"), nullptr);
    ASSERT_EQ(city.find("user")->polygons.size(), 1u);
    EXPECT_EQ(city.find("user")->polygons[0].exterior, city.find("owner")->polygons[0].exterior);
    EXPECT_EQ(city.objects.back().id, "user");  // behind all objects without links
  }
}

TEST(StreamReader, ChainsOfXlinksAcrossMembersAreFollowed) {
  const std::string composite =
      "<gml:CompositeSurface gml:id=\"c\">" + xlink_member("p") + "</gml:CompositeSurface>";
  const City city = read(city_model(
      member(building_of("A", lod2_solid(xlink_member("c")))) +
      member(building_of("B", "<bldg:lod2MultiSurface>" + composite + "</bldg:lod2MultiSurface>")) +
      member(building_of("C", boundary("WallSurface", surface_member(polygon("p", south_wall)))))));
  ASSERT_EQ(city.objects.size(), 3u);
  for (const char* id : {"A", "B", "C"}) EXPECT_EQ(city.find(id)->polygons.size(), 1u) << id;
}

TEST(StreamReader, XlinkToNothingIsCountedAndNamed) {
  const City city = read_member(building_of(
      "A", lod2_solid(xlink_member("ghost") + surface_member(polygon("p", square_at_one)))));
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons.size(), 1u);
  EXPECT_EQ(city.report.skipped.at("xlink: target not in the file (gml:surfaceMember)"), 1u);
  ASSERT_EQ(city.report.warnings.size(), 1u);
  EXPECT_NE(city.report.warnings[0].find("ghost"), std::string::npos);
}

TEST(StreamReader, CyclesOfXlinksEnd) {
  const auto composite = [](const std::string& id, const std::string& members) {
    return "<gml:surfaceMember><gml:CompositeSurface gml:id=\"" + id + "\">" + members +
           "</gml:CompositeSurface></gml:surfaceMember>";
  };
  const City within = read_member(building_of(
      "A",
      lod2_solid(composite("a", xlink_member("b")) +
                 composite("b", xlink_member("a") + surface_member(polygon("p", square_at_one))))));
  EXPECT_EQ(within.objects.at(0).polygons.size(), 1u);
  const City across =
      read(city_model(member(building_of("A", lod2_solid(composite("a", xlink_member("b"))))) +
                      member(building_of("B", lod2_solid(composite("b", xlink_member("a")))))));
  EXPECT_EQ(across.objects.size(), 2u);
}

TEST(StreamReader, TreesOfXlinksDoNotMultiply) {
  // Ten links to ten links, ten levels deep: 10^10 polygons if each were followed.
  std::string levels = surface_member(polygon("l0", square_at_one));
  for (int level = 1; level <= 10; ++level) {
    std::string links;
    for (int i = 0; i < 10; ++i) links += xlink_member(numbered("l", level - 1));
    levels += "<gml:surfaceMember><gml:CompositeSurface gml:id=\"" + numbered("l", level) + "\">" +
              links + "</gml:CompositeSurface></gml:surfaceMember>";
  }
  EXPECT_EQ(read_member(building_of("A", lod2_solid(levels + xlink_member("l10"))))
                .objects.at(0)
                .polygons.size(),
            1u);
  const std::string implicit =
      "<frn:CityFurniture "
      "gml:id=\"F\"><frn:lod2ImplicitRepresentation><core:ImplicitGeometry><core:"
      "relativeGMLGeometry>" +
      multi_surface(levels + xlink_member("l10")) +
      "</core:relativeGMLGeometry></core:ImplicitGeometry></frn:lod2ImplicitRepresentation></"
      "frn:CityFurniture>";
  EXPECT_EQ(read_member(implicit).objects.at(0).polygons.size(), 1u);
}

TEST(StreamReader, OrientableSurfaceMinusTurnsDirectAndLinkedPolygons) {
  const auto oriented = [](const std::string& base) {
    return "<gml:surfaceMember><gml:OrientableSurface orientation=\"-\">" + base +
           "</gml:OrientableSurface></gml:surfaceMember>";
  };
  const std::string direct =
      oriented("<gml:baseSurface>" + polygon("p", square_at_one) + "</gml:baseSurface>");
  EXPECT_LT(
      area(read_member(building_of("A", lod2_solid(direct))).objects.at(0).polygons.at(0).exterior)
          .z,
      0);
  const City linked = read(city_model(
      member(building_of("A", lod2_solid(oriented("<gml:baseSurface xlink:href=\"#q\"/>")))) +
      member(
          building_of("B", boundary("RoofSurface", surface_member(polygon("q", square_at_one)))))));
  EXPECT_LT(area(linked.find("A")->polygons.at(0).exterior).z, 0);
  EXPECT_GT(area(linked.find("B")->polygons.at(0).exterior).z, 0);
  EXPECT_GT(area(read_member(
                     building_of(
                         "A", lod2_solid(oriented(
                                  "<gml:baseSurface><gml:OrientableSurface orientation=\"-\">"
                                  "<gml:baseSurface>" +
                                  polygon("p", square_at_one) +
                                  "</gml:baseSurface></gml:OrientableSurface></gml:baseSurface>"))))
                     .objects.at(0)
                     .polygons.at(0)
                     .exterior)
                .z,
            0);
}

TEST(StreamReader, ImplicitGeometryIsSetDownByMatrixAndReferencePoint) {
  const auto lamp = [](const std::string& id, const std::string& shape, const std::string& place) {
    return member(
        "<frn:CityFurniture gml:id=\"" + id +
        "\"><frn:lod2ImplicitRepresentation><core:ImplicitGeometry>"
        "<core:transformationMatrix>0 -2 0 0 2 0 0 0 0 0 2 5 0 0 0 1</core:transformationMatrix>" +
        shape + "<core:referencePoint><gml:Point><gml:pos>" + place +
        "</gml:pos></gml:Point></core:referencePoint>"
        "</core:ImplicitGeometry></frn:lod2ImplicitRepresentation></frn:CityFurniture>");
  };
  const City city = read(
      city_model(lamp("one",
                      "<core:relativeGMLGeometry><gml:MultiSurface gml:id=\"shape\">" +
                          surface_member(polygon("p", "0 0 0 1 0 0 1 1 0 0 0 0")) +
                          "</gml:MultiSurface></core:relativeGMLGeometry>",
                      "1000 2000 30") +
                 lamp("two", "<core:relativeGMLGeometry xlink:href=\"#shape\"/>", "1100 2000 30")));
  ASSERT_EQ(city.objects.size(), 2u);
  // A quarter turn (x to y), twice as large, 5 up, then to the reference point.
  EXPECT_EQ(city.find("one")->polygons.at(0).exterior,
            (city::Ring{{1000, 2000, 35}, {1000, 2002, 35}, {998, 2002, 35}}));
  EXPECT_EQ(city.find("two")->polygons.at(0).exterior,
            (city::Ring{{1100, 2000, 35}, {1100, 2002, 35}, {1098, 2002, 35}}));
}

TEST(StreamReader, XlinksLeadIntoFilesOfTheSameCityAndNoOthers) {
  const TemporaryFile owner(city_model(member(building_of(
      "owner", boundary("RoofSurface", surface_member(polygon("shared", square_at_one)))))));
  std::string text = city_model(member(
      building_of("far", boundary("RoofSurface", surface_member(polygon("p", square_at_one))))));
  text.replace(text.find("EPSG:25833"), 10, "EPSG:3879");
  const TemporaryFile other_crs(text);
  const auto link = [](const TemporaryFile& file, const std::string& id) {
    return "<gml:surfaceMember xlink:href=\"./" + file.path().filename().string() + "#" + id +
           "\"/>";
  };
  const TemporaryFile user(city_model(member(building_of(
      "user", lod2_solid(link(owner, "shared") + link(owner, "absent") + link(other_crs, "p"))))));
  City city = read_file(user.path());
  EXPECT_EQ(city.find("user")->polygons.size(), 0u);
  const std::string elsewhere = "xlink: to another file (./";
  const auto file_name = [](const TemporaryFile& file) { return file.path().filename().string(); };
  EXPECT_EQ(city.report.skipped.at(elsewhere + file_name(owner) + ")"), 2u);
  EXPECT_EQ(city.report.skipped.at(elsewhere + file_name(other_crs) + ")"), 1u);

  city::ReadOptions options;
  options.neighbours = std::make_shared<const std::set<std::filesystem::path>>(
      std::set{owner.path(), other_crs.path(), user.path()});
  city = read_file(user.path(), options);
  ASSERT_EQ(city.objects.size(), 1u);
  ASSERT_EQ(city.find("user")->polygons.size(), 1u);
  EXPECT_EQ(city.find("user")->polygons[0].surface, city::SurfaceType::unknown);
  EXPECT_EQ(city.find("user")->polygons[0].exterior,
            read_file(owner.path()).find("owner")->polygons[0].exterior);
  EXPECT_EQ(city.report.skipped.count(elsewhere + file_name(owner) + ")"), 0u);
  EXPECT_EQ(city.report.warnings.size(), 3u) << "the absent one, the other CRS, and the one in it";
}

TEST(StreamReader, MaterialsColourPolygonsFromWithinAndFromAnywhereInTheFile) {
  const auto material = [](const std::string& target, const std::string& colour) {
    return "<app:Appearance><app:surfaceDataMember><app:X3DMaterial><app:diffuseColor>" + colour +
           "</app:diffuseColor><app:target>#" + target +
           "</app:target></app:X3DMaterial></app:surfaceDataMember></app:Appearance>";
  };
  const std::string local =
      building_of("A", "<app:appearance>" + material("p", "1 0.5 0") + "</app:appearance>" +
                           boundary("RoofSurface", surface_member(polygon("p", square_at_one))));
  const std::string surface =
      "<bldg:boundedBy><bldg:WallSurface><bldg:lod2MultiSurface><gml:MultiSurface gml:id=\"m\">" +
      surface_member(polygon("q", south_wall)) +
      "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:WallSurface></bldg:boundedBy>";
  const City city =
      read(city_model(member(local) + member(building_of("B", surface)) + "<app:appearanceMember>" +
                      material("m", "0.25 0.5 0.75") + "</app:appearanceMember>"));
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.find("A")->polygons.at(0).diffuse_colour, glm::vec3(1, 0.5, 0));
  EXPECT_EQ(city.find("B")->polygons.at(0).diffuse_colour, glm::vec3(0.25, 0.5, 0.75));

  // The appearance stands in the middle of a file, a megabyte from both ends: plain, gzipped, and
  // in an archive behind a document without any.
  std::string buildings;
  for (int n = 0; buildings.size() < 1'200'000; ++n)
    buildings += member(building("F" + std::to_string(n)));
  const std::string text =
      city_model(member(building_of("B", surface)) + buildings + "<app:appearanceMember>" +
                 material("m", "0.25 0.5 0.75") + "</app:appearanceMember>" + buildings);
  const TemporaryFile gz("", ".gml.gz"), archive("", ".zip");
  pack_gzip(gz.path(), text);
  pack_zip(archive.path(),
           {{"first.gml", city_model(member(building("A")))}, {"second.gml", text}});
  for (const City& found : {read(text), read_file(gz.path()), read_file(archive.path())}) {
    EXPECT_EQ(found.find("B")->polygons.at(0).diffuse_colour, glm::vec3(0.25, 0.5, 0.75));
    EXPECT_EQ(found.find("F0")->polygons.at(0).diffuse_colour, std::nullopt);
    EXPECT_EQ(found.report.skipped.count("appearanceMember"), 0u);
  }
}

TEST(StreamReader, CityGml3IsReadUnderAnyPrefix) {
  const std::string text =
      "<CityModel xmlns=\"http://www.opengis.net/citygml/3.0\" "
      "xmlns:b=\"http://www.opengis.net/citygml/building/3.0\""
      " xmlns:con=\"http://www.opengis.net/citygml/construction/3.0\" "
      "xmlns:g=\"http://www.opengis.net/gml/3.2\""
      " xmlns:tran=\"http://www.opengis.net/citygml/transportation/3.0\">"
      "<cityObjectMember><b:Building g:id=\"A\"><boundary><con:WallSurface "
      "g:id=\"w\"><lod2MultiSurface><g:MultiSurface>"
      "<g:surfaceMember><g:Polygon g:id=\"p\"><g:exterior><g:LinearRing><g:posList>0 0 0 1 0 0 1 0 "
      "1 0 0 1 0 "
      "0 0</g:posList>"
      "</g:LinearRing></g:exterior></g:Polygon></g:surfaceMember></g:MultiSurface></"
      "lod2MultiSurface></"
      "con:WallSurface></boundary>"
      "<con:height><con:Height><con:value uom=\"m\">17.5</con:value></con:Height></con:height>"
      "<con:dateOfConstruction>1987-01-01</con:dateOfConstruction><b:storeysAboveGround>5</"
      "b:storeysAboveGround>"
      "</b:Building></cityObjectMember>"
      "<cityObjectMember><tran:Road "
      "g:id=\"R\"><tran:section><tran:Section><tran:trafficSpace><tran:TrafficSpace><boundary>"
      "<tran:TrafficArea><lod2MultiSurface><g:MultiSurface><g:surfaceMember><g:Polygon><g:exterior>"
      "<g:"
      "LinearRing>"
      "<g:pos>0 0 0</g:pos><g:pos>1 0 0</g:pos><g:pos>1 1 0</g:pos><g:pos>0 0 "
      "0</g:pos></g:LinearRing></g:exterior></g:Polygon>"
      "</g:surfaceMember></g:MultiSurface></lod2MultiSurface></tran:TrafficArea></boundary></"
      "tran:TrafficSpace></tran:trafficSpace>"
      "</tran:Section></tran:section></tran:Road></cityObjectMember></CityModel>";
  const City city = read(text);
  EXPECT_EQ(city.report.version, "3.0");
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[0].polygons.at(0).surface, city::SurfaceType::wall);
  EXPECT_EQ(city.objects[0].measured_height_m, 17.5);
  EXPECT_EQ(city.objects[0].year, "1987");
  EXPECT_EQ(city.objects[0].storeys_above_ground, 5);
  EXPECT_EQ(city.objects[1].type, city::ObjectType::road);
  EXPECT_EQ(city.objects[1].polygons.at(0).surface, city::SurfaceType::traffic_area);
}

TEST(StreamReader, EveryElementNotUsedIsCountedByName) {
  const City city = read_member(building_of(
      "A",
      "<bldg:roofType>1000</bldg:roofType><gen:stringAttribute "
      "name=\"x\"><gen:value>1</gen:value></gen:stringAttribute>"
      "<uro:thing xmlns:uro=\"u\"><uro:lod0Geometry>" +
          multi_surface(surface_member(polygon("z", square_at_zero))) +
          "</uro:lod0Geometry></uro:thing>"
          "<bldg:interiorRoom><bldg:Room><bldg:lod4MultiSurface>" +
          multi_surface(surface_member(polygon("y", square_at_zero))) +
          "</bldg:lod4MultiSurface></bldg:Room></bldg:interiorRoom>" +
          boundary("RoofSurface", surface_member(polygon("p", square_at_one)) +
                                      surface_member(polygon("n", "0 0 NaN 1 0 0 1 1 0 0 0 0")) +
                                      surface_member(polygon("c", "0,5 0 0 1 0 0 1 1 0 0 0 0")) +
                                      surface_member(polygon("i", "0 0 0 1 0 0 1 1")) +
                                      surface_member(polygon("s", "0 0 0 1 0 0 0 0 0")))));
  const auto& skipped = city.report.skipped;
  EXPECT_EQ(city.report.polygons, 1u);
  EXPECT_EQ(skipped.at("bldg:roofType"), 1u);
  EXPECT_EQ(skipped.at("gen:stringAttribute"), 1u);
  EXPECT_EQ(skipped.at("uro:thing"), 1u);
  EXPECT_EQ(skipped.at("polygon: in uro:thing"), 1u);
  EXPECT_EQ(skipped.at("bldg:Room"), 1u);
  EXPECT_EQ(skipped.at("polygon: inside a building"), 1u);
  EXPECT_EQ(skipped.at("polygon: ring with coordinates that are no numbers"), 2u);
  EXPECT_EQ(skipped.at("polygon: ring with an incomplete vertex"), 1u);
  EXPECT_EQ(skipped.at("polygon: ring of fewer than three vertices"), 1u);
}

TEST(StreamReader, Gml2CoordinatesPointsAndTwoDimensionsAreRead) {
  const City city = read_member(building_of(
      "A",
      boundary(
          "RoofSurface",
          surface_member(
              "<gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>0,0,1 1,0,1 "
              "1,1,1 0,0,1"
              "</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon>") +
              surface_member(
                  "<gml:Polygon srsDimension=\"2\"><gml:exterior><gml:LinearRing><gml:posList>0 0 "
                  "5 0 5 5 0 0"
                  "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>"))));
  ASSERT_EQ(city.objects.at(0).polygons.size(), 2u);
  EXPECT_EQ(city.objects[0].polygons[0].exterior, (city::Ring{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}));
  EXPECT_EQ(city.objects[0].polygons[1].exterior, (city::Ring{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}}));
}

TEST(StreamReader, MassPointsBreakLinesAndGmlTinAreRead) {
  const City city = read_member(
      "<dem:ReliefFeature gml:id=\"R\"><dem:lod>1</dem:lod>"
      "<dem:reliefComponent><dem:MassPointRelief><dem:lod>1</"
      "dem:lod><dem:reliefPoints><gml:MultiPoint><gml:pointMember>"
      "<gml:Point><gml:pos>1 2 "
      "3</gml:pos></gml:Point></gml:pointMember></gml:MultiPoint></dem:reliefPoints></"
      "dem:MassPointRelief>"
      "</dem:reliefComponent><dem:reliefComponent><dem:BreaklineRelief><dem:lod>1</"
      "dem:lod><dem:breaklines><gml:MultiCurve>"
      "<gml:curveMember><gml:LineString><gml:posList>4 5 6 7 8 "
      "9</gml:posList></gml:LineString></gml:curveMember>"
      "</gml:MultiCurve></dem:breaklines></dem:BreaklineRelief></dem:reliefComponent>"
      "<dem:reliefComponent><dem:TINRelief><dem:tin><gml:Tin><gml:trianglePatches><gml:Triangle><"
      "gml:"
      "exterior>" +
      ring("0 0 0 9 0 0 0 9 0 0 0 0") +
      "</gml:exterior></gml:Triangle></gml:trianglePatches></gml:Tin></dem:tin></dem:TINRelief></"
      "dem:reliefComponent></dem:ReliefFeature>");
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.objects[0].points, (std::vector<glm::dvec3>{{1, 2, 3}}));
  EXPECT_EQ(city.objects[0].lines, (std::vector<city::Ring>{{{4, 5, 6}, {7, 8, 9}}}));
  EXPECT_EQ(city.objects[0].polygons.size(), 1u);
}

TEST(StreamReader, ManyThreadsGiveTheSameCityAsOne) {
  std::string members;
  for (int i = 0; i < 3000; ++i)
    members +=
        member(i % 500 == 7 ? building_of(numbered("far", i), lod2_solid(xlink_member("b0_r")))
                            : building(numbered("b", i), "<bldg:roofType>1</bldg:roofType>"));
  const TemporaryFile file(city_model(members));
  const City one =
      read_file(file.path(), {.max_lod = 2, .reader = city::Reader::stream, .threads = 1});
  for (int round = 0; round < 3; ++round) {
    const City four =
        read_file(file.path(), {.max_lod = 2, .reader = city::Reader::stream, .threads = 4});
    ASSERT_EQ(one.objects.size(), four.objects.size());
    for (std::size_t i = 0; i < one.objects.size(); ++i) {
      ASSERT_EQ(one.objects[i].id, four.objects[i].id);
      ASSERT_EQ(one.objects[i].polygons.size(), four.objects[i].polygons.size());
    }
    EXPECT_EQ(one.report.skipped, four.report.skipped);
    EXPECT_EQ(one.report.warnings, four.report.warnings);
  }
}

TEST(StreamReader, GzipAndZipGiveTheSameCity) {
  const std::string text = city_model(member(building("A")) + member(building("B")));
  const TemporaryFile gz("", ".gml.gz"), archive("", ".zip");
  pack_gzip(gz.path(), text);
  EXPECT_EQ(read_file(gz.path()).report.polygons, 6u);
  pack_zip(archive.path(), {{"one.gml", text}, {"notes.txt", text}, {"two.xml", text}});
  const City city = read_file(archive.path());
  EXPECT_EQ(city.objects.size(), 4u);
  EXPECT_EQ(city.report.polygons, 12u);
}

TEST(StreamReader, CutArchivesAreErrors) {
  const std::string text = city_model(member(building("A")));
  const TemporaryFile gz("", ".gml.gz");
  pack_gzip(gz.path(), text);
  std::filesystem::resize_file(gz.path(), std::filesystem::file_size(gz.path()) - 12);
  EXPECT_THROW(read_file(gz.path()), Error);
  EXPECT_THROW(read_file(TemporaryFile("PK\x03\x04 and no more", ".zip").path()), Error);
}

TEST(StreamReader, Latin1TextBecomesUtf8) {
  std::string text = city_model(member(building("A",
                                                "<bldg:function>B\xfc"
                                                "ro</bldg:function>")));
  text.replace(text.find("UTF-8"), 5, "ISO-8859-1");
  EXPECT_EQ(read(text).objects.at(0).function,
            "B\xc3\xbc"
            "ro");
}

TEST(StreamReader, AddressIsPutTogether) {
  const City city = read_member(building(
      "A",
      "<bldg:address><core:Address><core:xalAddress><xAL:AddressDetails "
      "xmlns:xAL=\"x\"><xAL:Country><xAL:CountryName>Germany"
      "</xAL:CountryName><xAL:Locality><xAL:LocalityName>Berlin</"
      "xAL:LocalityName><xAL:Thoroughfare><xAL:ThoroughfareNumber>12"
      "</xAL:ThoroughfareNumber><xAL:ThoroughfareName>Unter den "
      "Linden</xAL:ThoroughfareName></xAL:Thoroughfare></xAL:Locality>"
      "</xAL:Country></xAL:AddressDetails></core:xalAddress></core:Address></bldg:address>"));
  EXPECT_EQ(city.objects.at(0).address, "Unter den Linden 12, Berlin, Germany");
}

TEST(StreamReader, PartsWithBetterLodReplaceTheBlockOfTheirBuilding) {
  const std::string block = "<bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" +
                            surface_member(polygon("b", square_at_zero)) +
                            "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid>";
  const City city = read_member(building_of(
      "A", block +
               "<bldg:measuredHeight>3</"
               "bldg:measuredHeight><bldg:consistsOfBuildingPart><bldg:BuildingPart>"
               "<bldg:measuredHeight>9</bldg:measuredHeight><bldg:function>x</bldg:function>" +
               boundary("WallSurface", surface_member(polygon("w", south_wall))) +
               "</bldg:BuildingPart></bldg:consistsOfBuildingPart>"));
  ASSERT_EQ(city.objects.at(0).polygons.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons[0].id, "w");
  EXPECT_EQ(city.objects[0].measured_height_m, 9);
  EXPECT_EQ(city.objects[0].function, "x");
  EXPECT_EQ(city.report.skipped.at("polygon: lod1, another LoD taken"), 1u);
}

TEST(StreamReader, ObjectsInFeatureMembersAndWithoutIdAreRead) {
  const std::string text =
      "<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\" xmlns:bldg=\"b\" xmlns:gml=\"g\" "
      "xmlns:xlink=\"x\">\n"
      "<gml:featureMembers>\n" +
      building("A") + "\n<bldg:Building>" +
      boundary("RoofSurface", surface_member(polygon("p", square_at_one))) +
      "</bldg:Building>\n</gml:featureMembers></CityModel>";
  const City city = read(text);
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[0].id, "A");
  EXPECT_EQ(city.objects[1].id, "Building@4");  // its line: the same in every bake
}

TEST(CityGmlHead, TellsCrsVersionAndClosedRings) {
  const city::CityHead head =
      read_citygml_head(TemporaryFile(city_model(member(building("A")))).path());
  EXPECT_EQ(head.version, "2.0");
  EXPECT_EQ(head.srs_name, "EPSG:25833");
  ASSERT_EQ(head.sample.size(), 15u);  // three rings of four, each closed again
  EXPECT_EQ(head.sample[0], head.sample[4]);
}

}  // namespace
}  // namespace nightcity::citygml
