// Real cities for tests: present on a developer's machine, absent elsewhere. Tests that use them skip with a
// message.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace nightcity::test {

inline std::filesystem::path data_root() {
  if (const char* root = std::getenv("NIGHTCITY_DATA")) return root;
  return std::filesystem::path(NIGHTCITY_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace nightcity::test

/// Defines `variable` as the path of a real file, or skips the test.
#define REAL_DATA(variable, relative)                                                 \
  const std::filesystem::path variable = ::nightcity::test::data_root() / (relative); \
  if (!std::filesystem::exists(variable)) GTEST_SKIP() << "no real data at " << variable
