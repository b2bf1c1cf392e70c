// Reports the faults of the model's polygons that were found while they were triangulated.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/mesh/mesh_report.h"

namespace nightcity::bake {

nlohmann::json to_json(const mesh::MeshReport& mesh);
/// Returns a line for each kind of fault that there is.
std::string to_text(const mesh::MeshReport& mesh);

}  // namespace nightcity::bake
