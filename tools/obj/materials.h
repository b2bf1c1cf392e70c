// Diffuse colours of a material library (MTL).
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::obj {

struct Material {
  std::optional<glm::vec3> colour;  // Kd, taken as sRGB, 0 to 1
  bool has_texture = false;         // map_Kd: not read
};

/// Adds the materials of `file` by name. Throws Error, with the line, where a colour is none.
void read_materials(const std::filesystem::path& file, std::map<std::string, Material>& materials);

/// Returns the file that a library's name in an OBJ means: beside it or below. Empty where the name
/// leads elsewhere, or to no regular file.
std::filesystem::path find_library(const std::filesystem::path& obj, const std::string& name);

}  // namespace nightcity::obj
