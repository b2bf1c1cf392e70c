// Real cities for tests. Tests that use them are skipped, with a message, on machines without them.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace nightcity::test {

/// Returns the folder of real data: NIGHTCITY_DATA where it is set, else data/ in the repository,
/// else the one that several checkouts beside each other share (pipelines/README.md).
inline std::filesystem::path data_root() {
  if (const char* root = std::getenv("NIGHTCITY_DATA")) return root;
  const std::filesystem::path source = NIGHTCITY_SOURCE_DIR;
  if (std::filesystem::exists(source / "data")) return source / "data";
  return source / ".." / "shared" / "data";
}

}  // namespace nightcity::test

/// Defines `variable` as the path of a real file, or skips the test.
#define REAL_DATA(variable, relative)                                                 \
  const std::filesystem::path variable = ::nightcity::test::data_root() / (relative); \
  if (!std::filesystem::exists(variable)) GTEST_SKIP() << "no real data at " << variable
