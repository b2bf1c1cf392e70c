#include "formats/error.h"

#include <gtest/gtest.h>

namespace nightcity {
namespace {

TEST(Error, HasTheFormOfCompilersMessages) {
  const auto text = [](const Error& error) { return std::string(error.what()); };
  EXPECT_EQ(text(Error("city.gml", 12, "is not XML")), "city.gml:12: is not XML");
  EXPECT_EQ(text(Error("city.glb", "mesh 3", "is not there")), "city.glb: mesh 3: is not there");
  EXPECT_EQ(text(Error("city.glb", "is empty")), "city.glb: is empty");
}

TEST(Error, LeavesOutWhatIsNotKnown) {
  const auto text = [](const Error& error) { return std::string(error.what()); };
  EXPECT_EQ(text(Error("", "out of work")), "out of work");
  EXPECT_EQ(text(Error("", "mesh 3", "is not there")), "mesh 3: is not there");
  EXPECT_EQ(text(Error("", 12, "is not XML")), "line 12: is not XML");
  EXPECT_EQ(text(Error("city.gml", std::size_t{0}, "is not XML")), "city.gml: is not XML");
}

TEST(Error, KnowsItsLineAndItsExitCode) {
  EXPECT_EQ(Error("city.toml", 7, "unknown key").line(), 7u);
  EXPECT_EQ(Error("city.toml", "unknown key").line(), 0u);
  EXPECT_EQ(Error("city.gml", "is empty").exit_code(), ExitCode::bad_data);
  EXPECT_EQ(UsageError("city.toml", 7, "unknown key").exit_code(), ExitCode::bad_usage);
}

}  // namespace
}  // namespace nightcity
