// A bake: from open data to city.glb and city.lights.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/bake/bake_options.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/bake_report.h"

namespace nightcity::bake {

/// Leaves city.glb, city.lights and bake_report.json in `folder`, which is made where it is absent;
/// or throws Error and leaves nothing. The same options and inputs give the same bytes of city.glb
/// and city.lights.
BakeReport bake(const BakeOptions& options, const std::filesystem::path& folder,
                const ProgressSink& progress = {});

/// Does the same by a recipe. Throws UsageError where its keys contradict each other.
BakeReport bake(const Recipe& recipe, const std::filesystem::path& folder,
                const ProgressSink& progress = {});

/// Does the same from finished parts (parts/bake_part.h): the bytes are those of the whole bake.
/// `parts`: part files, and folders that hold some, in any order. `recipe`: "" stands for the one
/// that the parts name. `version`: of the program. Throws Error where parts are missing, damaged or
/// made from another recipe or other inputs.
BakeReport merge_parts(const std::vector<std::filesystem::path>& parts,
                       const std::filesystem::path& recipe, const std::filesystem::path& folder,
                       const std::string& version, const ProgressSink& progress = {},
                       unsigned threads = 0);

}  // namespace nightcity::bake
