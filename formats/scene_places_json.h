// Places of a scene as JSON: members of asset.extras.nightcity in city.glb.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "formats/scene_places.h"

namespace nightcity {

/// Adds the members `geographic` and `streets` to `extras`, unless they are empty. Throws Error,
/// without a file name, where a value is beyond the bounds that places_from_json accepts.
void add_to_json(const ScenePlaces& places, nlohmann::json& extras);

/// Returns the places in `extras`. A scene is shown without what is absent or unsound; of the
/// latter `skipped` gets a sentence.
ScenePlaces places_from_json(const nlohmann::json& extras, std::vector<std::string>& skipped);

/// Returns whether a name may stand in a file: not empty, not too long, without control characters,
/// which would reach a terminal.
bool is_street_name(const std::string& name);

}  // namespace nightcity
