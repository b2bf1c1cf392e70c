#include "tools/bake/scene/light_places.h"

#include <memory>
#include <optional>
#include <string_view>

#include "formats/scene_reader.h"
#include "tools/bake/scene/materials.h"

namespace nightcity::bake {
namespace {

constexpr double tolerance_m = 0.1;

std::optional<terrain::SurfaceClass> find_surface_class(const SceneNode& node,
                                                        std::string_view material) {
  if (node.kind == "terrain") return terrain::SurfaceClass::terrain;
  if (node.kind == "road") return terrain::SurfaceClass::road;
  if (node.kind != "city") return std::nullopt;
  if (is_of_kind(material, "ground")) return terrain::SurfaceClass::ground_surface;
  if (is_of_kind(material, "roof")) return terrain::SurfaceClass::roof;
  return std::nullopt;
}

}  // namespace

bool inside_building(const terrain::Terrain& terrain, const glm::dvec3& place) {
  const auto floor = terrain.height_of(terrain::SurfaceClass::ground_surface, glm::dvec2(place));
  if (!floor || place.z <= *floor) return false;
  const auto roof = terrain.height_of(terrain::SurfaceClass::roof, glm::dvec2(place));
  return roof && place.z < *roof - tolerance_m;
}

lights::PlaceFault find_place_faults(const std::filesystem::path& path) {
  const Scene scene = read_scene(path);
  const auto terrain = std::make_shared<terrain::Terrain>();
  for (const SceneNode& node : scene.nodes)
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives) {
      const auto surface_class = find_surface_class(node, scene.materials[primitive.material].name);
      if (!surface_class) continue;
      for (const SceneInstance& instance : node.instances) {
        mesh::TriangleMesh mesh;
        for (const glm::vec3& p : primitive.positions)
          mesh.positions.push_back(
              scene.georeference.from_model(glm::dvec3(instance.to_model * glm::vec4(p, 1))));
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
          mesh::MeshTriangle triangle{};
          for (std::size_t k = 0; k < 3; ++k) triangle.vertex[k] = primitive.indices[i + k];
          mesh.triangles.push_back(triangle);
        }
        terrain->add(mesh, *surface_class);
      }
    }
  terrain->build(0);
  return [terrain, georeference = scene.georeference](const Light& light) -> std::string {
    const glm::dvec3 place = georeference.from_model(glm::dvec3(light.position));
    const glm::dvec2 plan(place);
    if (const auto ground = terrain->height_at(plan);
        ground && ground->surface <= terrain::SurfaceClass::road &&
        place.z < ground->height_m - tolerance_m)
      return "below the ground";
    if (inside_building(*terrain, place)) return "inside a building";
    return {};
  };
}

}  // namespace nightcity::bake
