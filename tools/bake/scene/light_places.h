// Whether lights stand where lights can: above the ground and outside of buildings, by a baked scene.
#pragma once

#include <filesystem>

#include "tools/lights/light_census.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

/// Whether a place (E, N, H) lies under a roof and above a ground surface.
bool inside_building(const Terrain& terrain, const glm::dvec3& place);

/// Judges lights by the terrain, roads and buildings of a city.glb: "below the ground" is more than 10 cm
/// under terrain or road; "inside a building" is below a roof and above a ground surface on the same vertical
/// line. Throws Error as read_scene does.
PlaceFault place_faults_in(const std::filesystem::path& scene);

}  // namespace nightcity
