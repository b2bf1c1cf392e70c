// The georeference as JSON: the object in asset.extras.nightcity of city.glb and in section GEOR of
// city.lights.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "formats/georeference.h"

namespace nightcity {

nlohmann::json georeference_to_json(const Georeference& georeference);

/// Returns the georeference in `json`; missing members keep their defaults. Throws Error, without a
/// file name, if a member has the wrong type or the origin is not three finite numbers.
Georeference georeference_from_json(const nlohmann::json& json);

}  // namespace nightcity
