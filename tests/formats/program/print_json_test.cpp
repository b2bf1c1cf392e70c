#include "formats/program/print_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace nightcity::program {
namespace {

TEST(PrintJson, ReplacesBytesThatAreNoUtf8) {
  const nlohmann::json value = {{"id",
                                 "stra\xDF"
                                 "e"}};  // Latin-1
  const auto read_back = nlohmann::json::parse(to_json_text(value));
  EXPECT_EQ(read_back["id"], "stra\uFFFDe");
}

TEST(PrintJson, KeepsTheOrderOfOrderedObjects) {
  const nlohmann::ordered_json value = {{"z", 1}, {"a", 2}};
  EXPECT_EQ(to_json_text(value), "{\n  \"z\": 1,\n  \"a\": 2\n}");
}

TEST(PrintJson, WritesOneDocumentAndANewlineToStdout) {
  testing::internal::CaptureStdout();
  print_json(nlohmann::json{{"lamps", 3}});
  print_json(nlohmann::ordered_json(4));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "{\n  \"lamps\": 3\n}\n4\n");
}

}  // namespace
}  // namespace nightcity::program
