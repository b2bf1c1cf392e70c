// A real place, small: 61 buildings of Berlin and the lamps around them, baked by nightbake as its
// users do.
#pragma once

#include <gtest/gtest.h>

#include "support/data.h"
#include "support/process.h"

namespace nightcity::test {

/// Bakes into `folder`, with lit windows if `windows` is set, and with what the map knows of the
/// ground if `ground` is. Returns false, and fails the test, when nightbake fails.
inline bool bake_berlin(const TempFolder& folder, bool windows, bool ground = true) {
  const std::string bare =
      "[ground]\nstreets = false\nland = false\ngaps = false\nhorizon = false\ntrees = \"none\"\n";
  const std::filesystem::path data = std::filesystem::absolute(data_root()) / "berlin";
  write_text(folder / "berlin.toml",
             "[city]\nfiles = [\"" + (data / "berlin_open_data_sample_data.citygml").string() +
                 "\"]\n[osm]\nfiles = [\"" + (data / "berlin_dev_box.osm.pbf").string() +
                 "\"]\n[windows]\nlit = " + (windows ? "true" : "false") + "\n" +
                 (ground ? "" : bare));
  const Outcome outcome = run_program("nightbake", "run '" + (folder / "berlin.toml").string() +
                                                       "' --out '" + folder.path().string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return outcome.exit_code == 0;
}

}  // namespace nightcity::test

/// Bakes Berlin into a new TempFolder called `folder`, with bake_berlin's other arguments, or skips
/// the test when the data or nightbake is missing.
#define BAKED_BERLIN(folder, ...)                                                         \
  REAL_DATA(folder##_city, "berlin/berlin_open_data_sample_data.citygml");                \
  REAL_DATA(folder##_map, "berlin/berlin_dev_box.osm.pbf");                               \
  if (!std::filesystem::exists(std::filesystem::path(NIGHTCITY_BUILD_DIR) / "nightbake")) \
    GTEST_SKIP() << "nightbake is not built";                                             \
  const ::nightcity::test::TempFolder folder;                                             \
  if (!::nightcity::test::bake_berlin(folder, __VA_ARGS__)) return
