// A bake: from open data to city.glb and city.lights.
#pragma once

#include <filesystem>

#include "tools/bake/bake_options.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/bake_report.h"

namespace nightcity::bake {

/// Leaves city.glb, city.lights and bake_report.json in `folder`, which is made where it is absent;
/// or throws Error and leaves nothing. The same options and inputs give the same bytes of city.glb
/// and city.lights.
BakeReport bake(const BakeOptions& options, const std::filesystem::path& folder,
                const ProgressSink& progress = {});

/// Does the same by a recipe.
BakeReport bake(const Recipe& recipe, const std::filesystem::path& folder,
                const ProgressSink& progress = {});

}  // namespace nightcity::bake
