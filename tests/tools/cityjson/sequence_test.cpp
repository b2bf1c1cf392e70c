// CityJSONSeq: a line of what features share, then a feature a line.
#include <gtest/gtest.h>
#include <zlib.h>

#include "formats/error.h"
#include "tests/tools/cityjson/read_text.h"
#include "tests/tools/cityjson/small_cityjson.h"

namespace nightcity::cityjson {
namespace {

using namespace test;

TEST(CityJsonSeq, EachLineIsAFeatureWithItsOwnVertices) {
  std::string text = header();
  for (int i = 0; i < 5000; ++i) {
    const std::string id = "b" + std::to_string(i);
    text += feature(id, object(id, "Building", "", "\"children\":[\"" + id + "-p\"]") + "," +
                            object(id + "-p", "BuildingPart", solid("\"2.2\"", box_semantics()),
                                   "\"parents\":[\"" + id + "\"]"));
    if (i % 100 == 0) text += "\r\n";
  }
  for (const unsigned threads : {1u, 0u}) {
    city::ReadOptions options;
    options.threads = threads;
    const City read = read_city(text, options);
    ASSERT_EQ(read.objects.size(), 5000u);
    for (std::size_t i = 0; i < read.objects.size(); ++i) {
      EXPECT_EQ(read.objects[i].id, "b" + std::to_string(i));
      EXPECT_NEAR(volume(read.objects[i]), 24, 1e-9);
    }
    EXPECT_EQ(read.report.srs_name, "EPSG:7415");
    EXPECT_EQ(read.report.version, "2.0");
    EXPECT_EQ(read.report.objects, 5000u);
  }
}

TEST(CityJsonSeq, AFeatureMayHaveAnAppearanceOfItsOwn) {
  const auto appearance = [](const char* colour) {
    return std::string("\"appearance\":{\"materials\":[{\"diffuseColor\":") + colour + "}]}";
  };
  const std::string painted =
      object("a", "Building", solid("\"2\"", "\"material\":{\"\":{\"value\":0}}"));
  const City read = read_city(header(appearance("[1,0,0]")) + feature("a", painted) +
                              feature("a", painted, appearance("[0,1,0]")));
  EXPECT_EQ(read.objects[0].polygons[0].diffuse_colour, glm::vec3(1, 0, 0));
  EXPECT_EQ(read.objects[1].polygons[0].diffuse_colour, glm::vec3(0, 1, 0));
}

TEST(CityJsonSeq, TheHeadComesFromTheFirstFeatures) {
  std::string text = header();
  for (int i = 0; i < 500; ++i) text += feature("a", object("a", "Building", solid()));
  const TemporaryFile file(text + "{broken", ".city.jsonl");
  const city::CityHead head = read_cityjson_head(file.path());
  EXPECT_EQ(head.srs_name, "EPSG:7415");
  EXPECT_GE(head.sample.size(), 4096u);
  EXPECT_LT(head.sample.size(), 5000u) << "it stops when it has enough";
  EXPECT_EQ(head.sample[0], glm::dvec3(10, 20, 30));
}

TEST(CityJsonSeq, IsToldByItsFirstLine) {
  const std::string building = object("a", "Building", solid()), one = city_json(building);
  std::string in_lines;  // a line break wherever a blank may stand
  for (const char c : one) in_lines += c == ',' || c == '{' ? std::string{c, '\n'} : std::string{c};
  const std::string sequence = header() + feature("a", building);
  for (const std::string& text : {one, one + "\n", one + "\r\n \n\n", in_lines, "\n" + in_lines,
                                  sequence, "\r\n\n" + sequence, sequence + "\n\n"})
    EXPECT_EQ(read_city(text).objects.size(), 1u) << text;
  EXPECT_NE(error_of(one + one).find("not JSON"), std::string::npos) << error_of(one + one);
}

TEST(CityJsonSeq, IsReadGzippedToo) {
  const std::string text = header() + feature("a", object("a", "Building", solid()));
  const TemporaryFile file("", ".jsonl.gz");
  const gzFile out = gzopen(file.path().c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  int objects = 0;
  const city::ObjectSink count = [&](city::CityObject&&) { ++objects; };
  read_cityjson_staged(file.path(), {}, city::deliver_to(count));
  EXPECT_EQ(objects, 1);
}

TEST(CityJsonSeq, ErrorsNameTheLine) {
  const std::string good = feature("a", object("a", "Building", solid()));
  EXPECT_NE(error_of(header() + good + "{\"type\":\"CityJSONFeature\",\n").find(":3: not JSON"),
            std::string::npos);
  EXPECT_NE(error_of(header() + good + header()).find(":3: a second \"CityJSON\""),
            std::string::npos);
  EXPECT_NE(error_of(header() + good + "[1]\n").find(":3: is no CityJSONFeature"),
            std::string::npos);
  EXPECT_NE(error_of(header() + "{\"type\":\"Feature\"}\n").find(":2: is no CityJSONFeature"),
            std::string::npos);
  EXPECT_NE(error_of(good + good).find(":1: is no CityJSON: its \"type\" is \"CityJSONFeature\""),
            std::string::npos);
  EXPECT_NE(error_of(good).find("needs a first line of type"), std::string::npos);
}

TEST(CityJsonSeq, AFirstLineThatIsCutOffIsNamed) {
  const std::string head = header();
  const std::string text =
      head.substr(0, head.size() - 20) + "\n" + feature("b", object("b", "Building", solid()));
  const std::string error = error_of(text);
  EXPECT_NE(error.find(":1: the first line of a CityJSONSeq"), std::string::npos) << error;
}

// OGC API Features, as 3DBAG's: the header under "metadata", the features beside it.
TEST(CityJsonSeq, AServersAnswerIsASequence) {
  const std::string metadata = "\"metadata\":" + header();
  const std::string one = feature("b", object("b", "Building", solid()));
  const std::string two = feature("c", object("c", "Building", solid()));
  EXPECT_EQ(read_city("\xEF\xBB\xBF{\"feature\":" + one + "," + metadata + "}").report.polygons,
            6u);
  const City item = read_city("{\"id\":\"b\",\"feature\":" + one + "," + metadata + "}");
  ASSERT_EQ(item.objects.size(), 1u);
  EXPECT_NEAR(volume(item.objects[0]), 24, 1e-9);
  EXPECT_EQ(item.report.srs_name, "EPSG:7415");
  EXPECT_TRUE(item.report.warnings.empty());
  struct Case {
    std::string more, words;
  };
  for (const Case& c :
       {Case{",\"numberMatched\":9,\"numberReturned\":2", "incomplete: the server gave 2 of 9"},
        Case{",\"links\":[{\"rel\":\"next\",\"href\":\"x\"}]", "one page of several"},
        Case{",\"links\":[{\"rel\":\"self\",\"href\":\"x\"}]", ""}}) {
    const City page = read_city("{\"type\":\"FeatureCollection\",\"features\":[" + one + "," + two +
                                "]," + metadata + c.more + "}");
    EXPECT_EQ(page.objects.size(), 2u);
    ASSERT_EQ(page.report.warnings.size(), c.words.empty() ? 0u : 1u) << c.more;
    if (c.words.empty()) continue;
    EXPECT_NE(page.report.warnings[0].find(c.words), std::string::npos) << page.report.warnings[0];
  }
}

// An answer is held as a whole, so it is bounded; a sequence may be of any length.
TEST(CityJsonSeq, AHeaderWhoseKeysComeAsAnAnswersIsASequence) {
  const std::string more =
      std::string("\"version\":\"2.0\",") + transform + ",\"CityObjects\":{},\"vertices\":[]}\n";
  city::ReadOptions options;
  options.max_member_mb = 1;
  std::string features;
  std::size_t count = 0;
  for (; features.size() < 2u << 20; ++count)
    features += feature("b", object("b" + std::to_string(count), "Building", solid()));
  for (const char* first :
       {"\"metadata\":{\"referenceSystem\":\"EPSG:7415\"},\"type\":\"CityJSON\",",
        "\"id\":\"x\",\"type\":\"CityJSON\","})
    EXPECT_EQ(read_city("{" + std::string(first) + more + features, options).objects.size(), count);
}

}  // namespace
}  // namespace nightcity::cityjson
