// Checks lights against a baked scene: they belong above the ground and outside of buildings.
#pragma once

#include <filesystem>

#include "tools/lights/light_statistics.h"
#include "tools/terrain/terrain.h"

namespace nightcity::bake {

/// Returns whether a place (E, N, H) lies under a roof and above a ground surface.
bool inside_building(const terrain::Terrain& terrain, const glm::dvec3& place);

/// Returns a function that checks one light against the terrain, roads and buildings of a city.glb:
/// "below the ground" is more than 10 cm under terrain or road; "inside a building" is below a roof
/// and above a ground surface on the same vertical line; "" is neither. Throws Error as read_scene
/// does.
lights::PlaceFault find_place_faults(const std::filesystem::path& scene);

}  // namespace nightcity::bake
