#include "formats/json_parse.h"

#include <gtest/gtest.h>

#include <string>

#include "formats/error.h"

namespace nightcity {
namespace {

std::string nested(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

TEST(JsonParse, ReadsDocumentsUpToItsDepthAndRefusesDeeperOnes) {
  EXPECT_EQ(parse_json(R"({"a": ["\"[[[", 1]})", "x")["a"][1], 1);
  EXPECT_TRUE(parse_json(nested(max_json_depth), "x").is_array());
  for (const std::string& deep : {nested(max_json_depth + 1), nested(300'000)}) {
    EXPECT_TRUE(try_parse_json(deep).is_discarded());
    try {
      parse_json(deep, "deep.json");
      FAIL() << "read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("deep.json: nests"), std::string::npos);
    }
  }
}

TEST(JsonParse, RefusesWhatIsNoJson) {
  for (const char* text : {"", "{", "[1", "\"", "\"\\", "nul", "]["}) {
    EXPECT_THROW(parse_json(text, "x"), Error) << text;
    EXPECT_TRUE(try_parse_json(text).is_discarded()) << text;
  }
}

// A user reads where the fault is, and no name of a library's class.
TEST(JsonParse, SaysWhereTheFaultIs) {
  try {
    parse_json("{\n  \"a\": x}", "a.json");
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("a.json: is no JSON: parse error at line 2"), std::string::npos) << text;
    EXPECT_EQ(text.find("json.exception"), std::string::npos) << text;
  }
}

// Many brackets beside each other, and in strings, are no depth.
TEST(JsonParse, CountsOnlyWhatLiesInEachOther) {
  std::string flat = "[";
  for (int i = 0; i < 1000; ++i) flat += "[],";
  flat += "\"" + std::string(1000, '[') + "\"]";
  EXPECT_EQ(parse_json(flat, "x").size(), 1001u);
}

}  // namespace
}  // namespace nightcity
