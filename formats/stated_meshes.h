// The properties of meshes that a glTF document states, without reading the meshes.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "formats/gltf_document.h"

namespace nightcity {

// SceneFile's functions of these names say what they return.
std::size_t count_stated_triangles(const gltf::Document& document, std::size_t mesh);
std::optional<std::array<glm::vec3, 2>> find_stated_bounds(const gltf::Document& document,
                                                           std::size_t mesh);
std::vector<bool> list_used_materials(const gltf::Document& document);

/// Returns whether vertices of some mesh have colours.
bool has_vertex_colours(const gltf::Document& document);

}  // namespace nightcity
