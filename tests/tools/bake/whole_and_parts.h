// A bake as a whole beside the same bake in parts.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/bake/bake.h"
#include "tools/bake/parts/bake_part.h"

namespace nightcity::bake {

namespace fs = std::filesystem;

inline std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline BakedPart make_part(const fs::path& recipe, std::uint32_t number, std::uint32_t count,
                           const fs::path& out) {
  return bake_part(make_bake_options(read_recipe(recipe)), {number, count}, out, "test");
}

/// Makes all parts of a recipe, the last one first.
inline void make_parts(const fs::path& recipe, std::uint32_t count, const fs::path& out) {
  for (std::uint32_t number = count; number > 0; --number) make_part(recipe, number, count, out);
}

/// Returns the report of a bake without its times and memory, which are never the same.
inline nlohmann::json report_of(const fs::path& folder) {
  nlohmann::json report = nlohmann::json::parse(bytes_of(folder / "bake_report.json"));
  report.erase("seconds");
  report.erase("peak_mb");
  if (report["traffic"].is_object()) report["traffic"].erase("seconds");
  return report;
}

/// The files of a bake.
struct Baked {
  std::string scene, lights;
  nlohmann::json report;
  explicit Baked(const fs::path& folder)
      : scene(bytes_of(folder / "city.glb")),
        lights(bytes_of(folder / "city.lights")),
        report(report_of(folder)) {}
  bool operator==(const Baked&) const = default;
};

inline Baked bake_whole(const fs::path& recipe, const fs::path& out) {
  bake(read_recipe(recipe), out);
  return Baked(out);
}

/// Expects that parts, merged, give the files and figures of the whole bake, for each number of
/// parts. `folder` takes the bakes.
inline void expect_parts_as_whole(const fs::path& recipe, const fs::path& folder,
                                  const std::vector<std::uint32_t>& counts) {
  const Baked whole = bake_whole(recipe, folder / "whole");
  ASSERT_FALSE(whole.scene.empty());
  for (const std::uint32_t count : counts) {
    SCOPED_TRACE(count);
    const fs::path out = folder / std::to_string(count);
    make_parts(recipe, count, out);
    merge_parts({out}, {}, out, "test");
    const Baked merged(out);
    EXPECT_TRUE(merged.scene == whole.scene && merged.lights == whole.lights);
    EXPECT_EQ(nlohmann::json::diff(whole.report, merged.report).dump(1), "[]");
  }
}

}  // namespace nightcity::bake
