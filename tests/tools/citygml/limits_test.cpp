// Small files that would take much time or memory: what bounds them, and that the bounds can be
// raised.
#include <gtest/gtest.h>
#include <zip.h>
#include <zlib.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "formats/error.h"
#include "tests/tools/citygml/read_file.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/city/byte_source.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

using namespace test;

std::string error_of(const std::string& text, const city::ReadOptions& options = {}) {
  try {
    read(text, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

std::string building_with(const std::string& id, const std::string& surfaces) {
  return member("<bldg:Building gml:id=\"B" + id + "\"><bldg:lod2MultiSurface>" +
                "<gml:MultiSurface gml:id=\"" + id + "\">" + surfaces +
                "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:Building>");
}

// Each level is a member of its own, whose surface is `links` links to the level below.
std::string levels_of_links(int levels, int links) {
  std::string text = building_with("l0", surface_member(polygon("p", square_at_one)));
  for (int level = 1; level <= levels; ++level) {
    std::string surfaces;
    for (int i = 0; i < links; ++i) surfaces += xlink_member("l" + std::to_string(level - 1));
    text += building_with("l" + std::to_string(level), surfaces);
  }
  return city_model(text);
}

TEST(Limits, LinksToLinksAcrossMembersDoNotMultiply) {
  // A member of the third level would have 60^3 copies of one square.
  const City city = read(levels_of_links(3, 60));
  ASSERT_EQ(city.objects.size(), 4u);
  for (const city::CityObject& object : city.objects)
    EXPECT_EQ(object.polygons.size(), 1u) << object.id;
  for (const auto& [what, count] : city.report.skipped)
    EXPECT_EQ(count, 0u) << what << ": only copies could have been skipped";
}

TEST(Limits, LinkedGeometryIsBoundedAndTheLimitNamed) {
  std::string squares, users;
  for (int i = 0; i < 10; ++i) {
    const std::string z = std::to_string(i);
    squares += surface_member(
        polygon("p" + z, "0 0 " + z + " 1 0 " + z + " 1 1 " + z + " 0 1 " + z + " 0 0 " + z));
  }
  const std::string text =
      city_model(building_with("owner", squares) + building_with("user", xlink_member("owner")));
  city::ReadOptions options;
  EXPECT_EQ(read(text, options).objects.at(1).polygons.size(), 10u);
  options.max_linked_vertices = 20;
  const City city = read(text, options);
  ASSERT_EQ(city.objects.size(), 2u);
  EXPECT_EQ(city.objects[1].polygons.size(), 0u);
  std::string warnings;
  for (const std::string& warning : city.report.warnings) warnings += warning + "\n";
  EXPECT_NE(warnings.find("[city] max_linked_vertices = 20"), std::string::npos) << warnings;
}

TEST(Limits, TextBetweenMembersIsNotKeptHoweverLong) {
  const std::string blanks(std::size_t{3} << 20, ' ');
  city::ReadOptions options;
  options.max_member_mb = 1;
  const std::string one = building_with("a", surface_member(polygon("p", square_at_one))),
                    two = building_with("b", surface_member(polygon("q", square_at_zero)));
  EXPECT_EQ(read(city_model(blanks + one + blanks + two + blanks), options).objects.size(), 2u);
  const std::string line = error_of(city_model(one + std::string(5000000, '\n') + "</wrong>"));
  EXPECT_NE(line.find(":5000005:"), std::string::npos) << line;
}

TEST(Limits, AMemberBeyondTheLimitNamesIt) {
  const std::string text = city_model(building_with(
      "a", std::string(std::size_t{3} << 20, ' ') + surface_member(polygon("p", square_at_one))));
  city::ReadOptions options;
  options.max_member_mb = 1;
  const std::string error = error_of(text, options);
  EXPECT_NE(error.find("1 MB"), std::string::npos) << error;
  EXPECT_NE(error.find("[city] max_member_mb"), std::string::npos) << error;
  options.max_member_mb = 8;
  EXPECT_EQ(read(text, options).objects.size(), 1u);
}

TEST(Limits, ATagOfAMillionAttributesIsReadInOnePass) {
  std::string text = city_model(building_with("a", surface_member(polygon("p", south_wall))));
  std::string attributes;
  for (int i = 0; i < 1'000'000; ++i) attributes += " a" + std::to_string(i) + "=\">\"";
  text.insert(text.find('>', text.find("CityModel")), attributes);
  const City city = read(text);
  ASSERT_EQ(city.objects.size(), 1u);
  EXPECT_EQ(city.objects[0].polygons.size(), 1u);
}

TEST(Limits, AZeroByteEndsTheReading) {
  // As the holes of a sparse file are read, terabytes long if need be.
  const std::string begun = city_model("").substr(0, city_model("").rfind("</core:CityModel>"));
  const std::string error = error_of(begun + std::string(100'000, '\0'));
  EXPECT_NE(error.find("zero byte"), std::string::npos) << error;
  EXPECT_THROW(read_citygml_head(TemporaryFile(begun + std::string(100'000, '\0')).path()), Error);
}

TEST(Limits, WhatUnpacksToHundredsOfTimesItsSizeIsRefusedBeyondAGigabyte) {
  // A stream may consist of many, so that one megabyte of blanks serves a thousand times.
  const auto packed = [](const std::string& text) {
    const TemporaryFile file("");
    const gzFile out = gzopen(file.path().c_str(), "wb");
    gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
    gzclose(out);
    std::ostringstream bytes;
    bytes << std::ifstream(file.path(), std::ios::binary).rdbuf();
    return bytes.str();
  };
  const std::string whole = city_model("");
  std::string bomb = packed(whole.substr(0, whole.rfind("</core:CityModel>")));
  const std::string blanks = packed(std::string(std::size_t{1} << 20, ' '));
  for (int i = 0; i < 1100; ++i) bomb += blanks;
  const TemporaryFile file(bomb);
  try {
    read_file(file.path());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("200 times"), std::string::npos) << error.what();
  }
}

TEST(Limits, AnArchiveIsOpenedOnceForAllItsEntries) {
  // Opening it anew for each entry takes time quadratic in their number. So an archive that is gone
  // after its entries have been listed can still be read.
  const TemporaryFile file("");
  const std::string text = city_model(building_with("a", surface_member(polygon("p", south_wall))));
  std::filesystem::remove(file.path());
  zip_t* zip = zip_open(file.path().c_str(), ZIP_CREATE, nullptr);
  for (const char* name : {"a.gml", "b.gml", "c.gml"})
    zip_file_add(zip, name, zip_source_buffer(zip, text.data(), text.size(), 0), 0);
  ASSERT_EQ(zip_close(zip), 0);
  const std::vector<city::Document> documents = city::list_documents(file.path(), citygml_endings);
  ASSERT_EQ(documents.size(), 3u);
  std::filesystem::remove(file.path());
  // Two at once, by turns.
  const auto a = documents[0].open(), b = documents[1].open();
  std::string read_a, read_b;
  char block[100];
  for (std::size_t got_a = 1, got_b = 1; got_a + got_b > 0;) {
    read_a.append(block, got_a = a->read(block, sizeof block));
    read_b.append(block, got_b = b->read(block, sizeof block));
  }
  EXPECT_EQ(read_a, text);
  EXPECT_EQ(read_b, text);
}

}  // namespace
}  // namespace nightcity::citygml
