// The places at a map's beginning: where in the world it lies.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <vector>

namespace nightcity::osm {

/// Returns longitude and latitude of up to `count` nodes from the file's beginning. Throws Error:
/// missing or broken.
std::vector<glm::dvec2> read_first_nodes(const std::filesystem::path& file, std::size_t count);

}  // namespace nightcity::osm
