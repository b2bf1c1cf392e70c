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

// Two parsers share the work: the faster one's documents are those of the other, which has the last
// word where the faster one knows no answer.
TEST(JsonParse, ReadsAsTheLibraryThatHoldsTheValues) {
  for (const char* text :
       {"null", "true", "[]", "{}", "[[],{}]", "0", "-0", "-1", "1.5", "-2.5e-3", "1e30", "1e400",
        "9223372036854775807", "-9223372036854775808", "18446744073709551615",
        "18446744073709551616", "-9223372036854775809", "0.1", "2.9189999103546143", "5e-324",
        "1e-400", "01", "+1", "1.", ".5", "nan", R"("é\u00e9\ud83d\ude00\n\/")", R"("\ud800")",
        R"("\x")", "\"\xff\"", "\"a\tb\"", R"({"a": 1, "b": [2, {"c": "d"}], "a": 3})",
        R"({"z": 0, "a": 0, "": null})", "[1, 2", "[1,]", "{\"a\" 1}", "[1] [2]", "\xEF\xBB\xBF[1]",
        "  [1]  ", "/* */ 1", ""}) {
    const nlohmann::json expected = nlohmann::json::parse(text, nullptr, false),
                         found = try_parse_json(text);
    EXPECT_EQ(found.is_discarded(), expected.is_discarded()) << text;
    if (expected.is_discarded()) continue;
    EXPECT_EQ(found, expected) << text;
    EXPECT_EQ(found.dump(), expected.dump()) << text;
    EXPECT_EQ(found.is_number_float(), expected.is_number_float()) << text;
    EXPECT_EQ(parse_json(text, "x"), expected) << text;
  }
  EXPECT_TRUE(try_parse_json("7").is_number_unsigned());
  EXPECT_FALSE(try_parse_json("-7").is_number_unsigned());
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
