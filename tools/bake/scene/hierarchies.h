// Hierarchies of static triangles in city.glb, so that nightview need not build them.
#pragma once

#include <filesystem>

#include "tools/bake/report/scene_report.h"

namespace nightcity::bake {

/// Adds the hierarchies of its static triangles to a finished scene; `lights` is the file beside
/// it. `threads`: 0 is one a core. The bytes do not depend on their number. Throws Error.
HierarchyReport add_hierarchies(const std::filesystem::path& glb,
                                const std::filesystem::path& lights, unsigned threads);

}  // namespace nightcity::bake
