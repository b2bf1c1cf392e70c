// The georeference as JSON: the same object in asset.extras.nightcity of city.glb and section GEOR of
// city.lights.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "formats/georeference.h"

namespace nightcity {

nlohmann::json georeference_to_json(const Georeference& georeference);

/// Missing members keep their defaults. Throws Error (no file name) on a member of the wrong type or an
/// origin that is not three finite numbers.
Georeference georeference_from_json(const nlohmann::json& json);

}  // namespace nightcity
