// Hostile CityJSON: an Error with file and line, or skipped and counted; never a crash.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formats/error.h"
#include "tests/tools/cityjson/read_text.h"
#include "tests/tools/cityjson/small_cityjson.h"

namespace nightcity::cityjson {
namespace {

using namespace test;

TEST(HostileCityJson, BrokenJsonIsAnErrorWithItsLine) {
  EXPECT_NE(error_of("{\n\"type\":\"CityJSON\",\n\"version\":\"2.0\"\n").find(":4: not JSON"),
            std::string::npos);
  EXPECT_NE(error_of("{\n\"type\":\"CityJSON\"\n\"version\":\"2.0\"}").find(":3: not JSON"),
            std::string::npos);
  EXPECT_NE(
      error_of("{\"type\":\"CityJSON\",\"version\":\"2.0\",\n\"CityObjects\":{\n\"a\":{\"type\":"
               "\"Building\",\"geometry\":[01]}},\"vertices\":[]}")
          .find(":3: not JSON"),
      std::string::npos);
  for (const char* text :
       {"", " ", "{", "{}", "{\"type\":\"CityJSON\"", "{\"type\":\"CityJSON\",}", "[]", "\"x\"",
        "{\"type\":\"CityJSON\" \"a\":1}", "{\"type\":\"CityJSON\",\"CityObjects\":{\"a\"",
        "{\"type\":\"CityJSON\",\"CityObjects\":{\"a\":}}", "{\"type\":\"CityJSON\"}}",
        "{\"type\":\"CityJSON\",\"vertices\":[[1,2}]}", "{\"type\":\"CityJSON\",\"a\":\"\\"})
    EXPECT_NE(error_of(text), "read") << text;
}

// A feature of a sequence is a line, and a document is read part by part: both as CityGML's
// members.
TEST(HostileCityJson, ALineOrPartThatIsTooLongNamesTheKeyThatAllowsIt) {
  const std::string blanks(3 << 20, ' ');
  const std::string document =
      city_json(object("a", "Building", solid(), "\"attributes\":{\"x\":\"" + blanks + "\"}"));
  const std::string header = city_json("") + "\n";
  const std::string sequence = header + "{\"type\":\"CityJSONFeature\",\"id\":\"" + blanks +
                               "\",\"CityObjects\":{},\"vertices\":[]}\n";
  for (const std::string& text : {document, sequence}) {
    city::ReadOptions options;
    options.max_member_mb = 1;
    std::string message;
    try {
      read_city(text, options);
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_NE(message.find("more than 1 MB is refused"), std::string::npos) << message;
    EXPECT_NE(message.find("[city] max_member_mb"), std::string::npos) << message;
    options.max_member_mb = 4;
    EXPECT_NO_THROW(read_city(text, options));
  }
}

TEST(HostileCityJson, OtherVersionsAndKindsAreNamed) {
  EXPECT_NE(error_of("{\"type\":\"CityJSON\",\"version\":\"0.9\"}").find("cjio upgrade"),
            std::string::npos);
  EXPECT_NE(error_of("{\"CityObjects\":{}}").find("no \"type\": \"CityJSON\""), std::string::npos);
  EXPECT_NE(error_of("{\"type\":\"Topology\"}").find("its \"type\" is \"Topology\""),
            std::string::npos);
  EXPECT_NE(
      error_of("{\"type\":\"CityJSON\",\"transform\":{\"scale\":[0,1,1],\"translate\":[0,0,0]}}")
          .find("\"transform\" needs"),
      std::string::npos);
}

TEST(HostileCityJson, GeometryThatCannotBeIsSkippedAndCounted) {
  const auto surface = [](const std::string& boundaries) {
    return "{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":" + boundaries + "}";
  };
  const auto skipped = [&](const std::string& geometry) {
    const City read = read_city(city_json(object("a", "Building", geometry)));
    for (const city::CityObject& o : read.objects) EXPECT_TRUE(o.polygons.empty()) << geometry;
    std::string names;
    for (const auto& [what, count] : read.report.skipped) names += what + ";";
    return names;
  };
  const std::string ring = "polygon: ring ";
  EXPECT_EQ(skipped(surface("[[[0,1,8]]]")), ring + "with a vertex that is not in the file;");
  EXPECT_EQ(skipped(surface("[[[0,1,-1]]]")), ring + "with a vertex number that is none;");
  EXPECT_EQ(skipped(surface("[[[0,1,1.5]]]")), ring + "with a vertex number that is none;");
  EXPECT_EQ(skipped(surface("[[[0,1,18446744073709551615]]]")),
            ring + "with a vertex that is not in the file;");
  EXPECT_EQ(skipped(surface("[[[0,1,1e300]]]")), ring + "with a vertex number that is none;");
  EXPECT_EQ(skipped(surface("[[[0,1]]]")), ring + "of fewer than three vertices;");
  EXPECT_EQ(skipped(surface("[[[0,1,0]]]")), ring + "of fewer than three vertices;");
  EXPECT_EQ(skipped(surface("[[]]")), "polygon: without rings;");
  EXPECT_EQ(skipped(surface("[3]")), "polygon: without rings;");
  EXPECT_EQ(skipped(surface("[[3]]")), ring + "that is no array;");
  EXPECT_EQ(skipped(surface("7")), "boundaries that are no array;");
  EXPECT_EQ(skipped("5"), "geometry that is no object;");
  EXPECT_EQ(skipped("{\"type\":\"Blob\",\"boundaries\":[]}"), "Blob;");
  EXPECT_EQ(skipped("{\"boundaries\":[]}"), "geometry without a type;");
  EXPECT_EQ(skipped("{\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[0]}"),
            "template that is not there;");
}

TEST(HostileCityJson, CoordinatesThatAreNoneLoseTheirPolygonsAlone) {
  // Vertices: text, too few, too many, beyond a double, null, no number, at a height that stands
  // for none.
  for (const char* bad : {"\"x\"", "[1,2]", "[1,2,3,4]", "[1,2,\"3\"]", "null", "[1,2,null]",
                          "[NaN,0,0]", "[0,-Infinity,0]"}) {
    const City read = read_city(
        "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{" +
        object("a", "Building",
               "{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":[[[0,1,2]],[[1,2,3]]]}") +
        "},\"vertices\":[" + bad + ",[0,0,0],[1,0,0],[0,1,0]]}");
    ASSERT_EQ(read.objects.size(), 1u);
    EXPECT_EQ(read.objects[0].polygons.size(), 1u) << bad;
    EXPECT_EQ(read.report.skipped.at("polygon: ring with coordinates that are no numbers"), 1u);
  }
  const City low =
      read_city("{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{" +
                object("a", "Building", "{\"type\":\"MultiSurface\",\"boundaries\":[[[0,1,2]]]}") +
                "},\"vertices\":[[0,0,-9999],[1,0,0],[0,1,0]]}");
  EXPECT_TRUE(low.objects[0].polygons.empty());
  EXPECT_NE(error_of("{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{},\"vertices\":"
                     "[[1e999,0,0]]}")
                .find("not JSON"),
            std::string::npos);
}

TEST(HostileCityJson, DeepNestingIsRefused) {
  const std::string deep(100'000, '['), closed(100'000, ']');
  EXPECT_NE(error_of(city_json(object("a", "Building", deep + closed))), "read");
  EXPECT_NE(error_of(city_json("", "\"metadata\":" + deep + closed)), "read");
  EXPECT_NE(error_of(header() + feature("a", object("a", "Building", deep + closed))), "read");
}

TEST(HostileCityJson, ABuildingOfVeryManyPartsIsReadInOnePass) {
  constexpr int count = 400'000;
  std::string children;
  for (int i = 0; i < count; ++i) children += (i ? ",\"p" : "\"p") + std::to_string(i) + "\"";
  const City read = read_city(
      city_json(object("a", "Building", solid(), "\"children\":[" + children + ",\"last\"]") + "," +
                object("last", "BuildingPart", solid(), "\"parents\":[\"a\"]")));
  ASSERT_EQ(read.objects.size(), 1u);
  EXPECT_EQ(read.objects[0].polygons.size(), 6u);  // the last part's, which stands for the whole
}

TEST(HostileCityJson, ParentsInACircleEndSomewhere) {
  const City read = read_city(
      city_json(object("a", "BuildingPart", solid(), "\"parents\":[\"b\"],\"children\":[\"b\"]") +
                "," + object("b", "BuildingPart", "", "\"parents\":[\"a\"],\"children\":[\"a\"]") +
                "," + object("c", "Building", "", "\"children\":[\"c\",\"c\"]")));
  EXPECT_EQ(read.objects.size(), 2u);
}

TEST(HostileCityJson, TemplatesPlacedWithoutEndAreLeftOut) {
  std::string faces, instances;
  for (int i = 0; i < 1000; ++i) faces += std::string(i ? "," : "") + "[[0,1,2]]";
  for (int i = 0; i < 2000; ++i)
    instances += std::string(i ? "," : "") +
                 "{\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[0]}";
  const City read = read_city(
      city_json(object("t", "SolitaryVegetationObject", instances),
                "\"geometry-templates\":{\"templates\":[{\"type\":\"MultiSurface\",\"lod\":\"2\","
                "\"boundaries\":[" +
                    faces + "]}],\"vertices-templates\":[[0,0,0],[1,0,0],[0,1,0]]}"));
  EXPECT_GT(read.report.skipped.at("templates: more polygons than an object may have"), 0u);
}

TEST(HostileCityJson, ChangedBytesNeverCrash) {
  std::mt19937 random(17);
  const std::string whole =
      city_json(object("a", "Building", solid("\"2\"", box_semantics()),
                       "\"attributes\":{\"measuredHeight\":5},\"children\":[\"p\"]") +
                    "," + object("p", "BuildingPart", solid("1"), "\"parents\":[\"a\"]"),
                "\"appearance\":{\"materials\":[{\"diffuseColor\":[1,0,0]}]}");
  const std::string lines = header() + feature("a", object("a", "Building", solid()));
  for (int n = 0; n < 2000; ++n) {
    std::string text = n % 2 ? whole : lines;
    for (unsigned k = 1 + random() % 4; k > 0; --k) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text.erase(at, 1 + random() % 20);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 20));
      }
    }
    try {
      for (const city::CityObject& o : read_city(text).objects)
        for (const city::Polygon& p : o.polygons)
          for (const glm::dvec3& v : p.exterior) ASSERT_TRUE(std::isfinite(v.x + v.y + v.z));
    } catch (const Error& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace nightcity::cityjson
