// The identity that the two files of a scene share: lights of another city are recognised.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/georeference.h"

namespace nightcity {

/// Returns the identity of a scene, 16 hexadecimal digits: a hash (XXH64) of its georeference and
/// of the checksum of its lights.
std::string make_scene_id(const Georeference& georeference, std::uint64_t lights_checksum);

/// Throws Error that names both files if these say that they belong to different scenes. A file
/// without an identity fits every other.
void require_same_scene(const std::filesystem::path& scene, const Georeference& of_scene,
                        const std::filesystem::path& lights, const Georeference& of_lights);

}  // namespace nightcity
