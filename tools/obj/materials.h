// Diffuse colours of a material library (MTL).
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::obj {

/// The picture of map_Kd, with the scale and the offset of its places (-s, -o).
struct Texture {
  std::string file;  // beside the OBJ or below, with forward slashes; "": elsewhere
  glm::dvec2 scale{1}, offset{0};
};

struct Material {
  std::optional<glm::vec3> colour;  // Kd, taken as sRGB, 0 to 1
  std::optional<Texture> texture;
};

/// Adds the materials of `file` by name. Pictures lie beside it, which is in `folder`, that of the
/// OBJ, or below. Throws Error, with the line, where a colour is none.
void read_materials(const std::filesystem::path& file, const std::filesystem::path& folder,
                    std::map<std::string, Material>& materials);

/// Returns the files of the statement `mtllib NAMES` in an OBJ, and in `absent` the names of those
/// that do not lie beside it or below. A name may hold blanks, so all of it is tried first.
std::vector<std::filesystem::path> find_libraries(const std::filesystem::path& obj,
                                                  std::string_view names,
                                                  std::vector<std::string>& absent);

/// Returns the file that a library's name in an OBJ means: beside it or below. Empty where the name
/// leads elsewhere, or to no regular file.
std::filesystem::path find_library(const std::filesystem::path& obj, const std::string& name);

}  // namespace nightcity::obj
