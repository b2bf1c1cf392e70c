#include "tools/bake/scene/window_models.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "formats/colour.h"

namespace nightcity::bake {
namespace {

constexpr double steps_per_stop = 4, cct_step_k = 250;

using Look = std::pair<int, int>;  // brightness and colour as an index into steps

Look to_look(const lights::LitRectangle& window) {
  return {static_cast<int>(std::lround(steps_per_stop * std::log2(double{window.luminance_cd_m2}))),
          static_cast<int>(std::lround(double{window.cct_k} / cct_step_k))};
}

SceneMaterial to_material(const Look& look, const char* name) {
  const auto luminance = static_cast<float>(std::exp2(look.first / steps_per_stop));
  const glm::vec3 colour = rec709_from_xy(planckian_xy(look.second * cct_step_k));
  return {.name = name,
          .base_colour = glm::vec3(0.1f),
          .emission_cd_m2 = colour * luminance,
          .roughness = 0.1f,
          .double_sided = false};
}

glm::vec3 to_model_axes(const glm::vec3& enh) {
  return {enh.x, enh.z, -enh.y};
}

// Counter-clockwise seen from outside: along is cross(up, normal).
void add_quad(ScenePrimitive& primitive, const lights::LitRectangle& window,
              const glm::dvec3& origin, std::uint32_t light) {
  const auto first = static_cast<std::uint32_t>(primitive.positions.size());
  const glm::vec3 centre = to_model_axes(glm::vec3(window.centre - origin));
  const glm::vec3 along = to_model_axes(window.along) * window.half_width;
  const glm::vec3 up = to_model_axes(glm::cross(window.normal, window.along)) * window.half_height;
  primitive.positions.insert(primitive.positions.end(), {centre - along - up, centre + along - up,
                                                         centre + along + up, centre - along + up});
  primitive.indices.insert(primitive.indices.end(),
                           {first, first + 1, first + 2, first, first + 2, first + 3});
  primitive.light_ids.insert(primitive.light_ids.end(), 4, light);
}

}  // namespace

void WindowModels::add(const lights::LitRectangle& window, std::uint32_t light) {
  const glm::dvec2 place = glm::dvec2(window.centre) / tile_m_;
  tiles_.add({static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y))},
             {window, light});
}

void WindowModels::write(SceneWriter& writer, const Georeference& georeference) {
  std::map<Look, std::uint32_t> materials;
  for (const Tile& tile : tiles_.keys()) {
    const glm::dvec3 origin(tile.first * tile_m_, tile.second * tile_m_, georeference.origin.z);
    std::map<Look, ScenePrimitive> primitives;
    for (const Record& record : tiles_.read(tile))
      add_quad(primitives[to_look(record.window)], record.window, origin, record.light);
    SceneMesh mesh;
    mesh.name = std::string(names_.meshes) + " " + std::to_string(tile.first) + " " +
                std::to_string(tile.second);
    for (auto& [look, primitive] : primitives) {
      const auto [material, is_new] = materials.try_emplace(look, 0);
      if (is_new) material->second = writer.add_material(to_material(look, names_.material));
      primitive.material = material->second;
      mesh.primitives.push_back(std::move(primitive));
    }
    SceneInstance instance;
    instance.to_model[3] = glm::vec4(glm::vec3(georeference.to_model(origin)), 1);
    writer.add_node({mesh.name, names_.kind, writer.add_mesh(mesh), false, {instance}});
  }
}

}  // namespace nightcity::bake
