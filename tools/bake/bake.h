// The whole way from open data to city.glb and city.lights.
#pragma once

#include <filesystem>

#include "tools/bake/progress.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/bake/report/bake_report.h"

namespace nightcity {

/// Leaves city.glb, city.lights and bake_report.json in `folder` (made where absent), or throws Error and
/// leaves nothing. The same recipe and inputs give the same bytes of city.glb and city.lights.
BakeReport bake(const Recipe& recipe, const std::filesystem::path& folder,
                const ProgressSink& progress = {});

}  // namespace nightcity
