#include "formats/stated_meshes.h"

#include <algorithm>
#include <glm/common.hpp>

#include "formats/gltf_constants.h"
#include "formats/scene_primitive_reader.h"

namespace nightcity {
namespace {

using gltf::Json;
using gltf::member;

}  // namespace

std::size_t count_stated_triangles(const gltf::Document& document, std::size_t mesh) {
  std::size_t count = 0;
  const Json& primitives = member(document.element("meshes", mesh), "primitives");
  for (const Json& primitive : primitives) {
    auto accessor = gltf::index(primitive, "indices");
    if (!accessor) accessor = gltf::index(member(primitive, "attributes"), "POSITION");
    if (!accessor || *accessor >= document.count("accessors")) continue;
    const std::size_t corners =
        gltf::index(document.element("accessors", *accessor), "count").value_or(0);
    count += std::min(PrimitiveReader::count_triangles(primitive, corners), document.bytes());
  }
  return std::min(count, document.bytes());
}

std::vector<bool> list_used_materials(const gltf::Document& document) {
  std::vector<bool> used(document.count("materials"));
  for (std::size_t mesh = 0; mesh < document.count("meshes"); ++mesh)
    for (const Json& primitive : member(document.element("meshes", mesh), "primitives"))
      if (const auto material = gltf::index(primitive, "material");
          material && *material < used.size())
        used[*material] = true;
  return used;
}

std::optional<std::array<glm::vec3, 2>> find_stated_bounds(const gltf::Document& document,
                                                           std::size_t mesh) {
  std::optional<std::array<glm::vec3, 2>> bounds;
  for (const Json& primitive : member(document.element("meshes", mesh), "primitives")) {
    const auto accessor = gltf::index(member(primitive, "attributes"), "POSITION");
    if (!accessor || *accessor >= document.count("accessors")) continue;
    const Json& positions = document.element("accessors", *accessor);
    std::array<glm::vec3, 2> box{};
    const auto read = [&](const char* key, glm::vec3& corner) {
      const Json& values = member(positions, key);
      if (!values.is_array() || values.size() != 3) return false;
      for (int axis = 0; axis < 3; ++axis) {
        const Json& value = values.at(static_cast<std::size_t>(axis));
        if (!value.is_number()) return false;
        corner[axis] = value.get<float>();
      }
      return true;
    };
    if (!read("min", box[0]) || !read("max", box[1])) continue;
    bounds =
        bounds ? std::array{glm::min((*bounds)[0], box[0]), glm::max((*bounds)[1], box[1])} : box;
  }
  return bounds;
}

bool has_vertex_colours(const gltf::Document& document) {
  for (std::size_t i = 0; i < document.count("meshes"); ++i)
    for (const Json& primitive : member(document.element("meshes", i), "primitives"))
      if (!member(member(primitive, "attributes"), gltf::colour_attribute).is_null()) return true;
  return false;
}

}  // namespace nightcity
