#include <map>
#include <set>

#include "formats/scene_reader.h"
#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {

Inspection inspect_scene(const std::filesystem::path& file) {
  const Scene scene = read_scene(file);
  Inspection result = make_empty_inspection("scene");
  const auto count_triangles = [](const SceneMesh& mesh) {
    std::size_t count = 0;
    for (const ScenePrimitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
    return count;
  };
  std::size_t triangles = 0, vertices = 0, shown = 0, instances = 0;
  std::map<std::string, std::size_t> by_material, nodes, features;
  for (const SceneMesh& mesh : scene.meshes) {
    triangles += count_triangles(mesh);
    for (const ScenePrimitive& primitive : mesh.primitives) {
      vertices += primitive.positions.size();
      by_material[scene.materials[primitive.material].name] += primitive.indices.size() / 3;
    }
  }
  Bounds bounds;
  std::map<std::string, std::set<std::uint32_t>> lights;  // by the kind of node that shows them
  for (const SceneNode& node : scene.nodes) {
    const SceneMesh& mesh = scene.meshes[node.mesh];
    const std::string kind = node.kind.empty() ? "other" : node.kind;
    ++nodes[kind];
    instances += node.instances.size();
    shown += count_triangles(mesh) * node.instances.size();
    for (const SceneInstance& instance : node.instances) {
      if (instance.light != no_id) lights[kind].insert(instance.light);
      for (const ScenePrimitive& primitive : mesh.primitives) {
        for (const glm::vec3& p : primitive.positions)
          bounds.add(glm::dvec3(instance.to_model * glm::vec4(p, 1)));
        for (const std::uint32_t id : primitive.light_ids)
          if (id != no_id) lights[kind].insert(id);
      }
    }
  }
  std::size_t buildings = 0;
  for (const SceneFeature& feature : scene.features) {
    ++features[feature.type.empty() ? "other" : feature.type];
    if (feature.type == "Building") ++buildings;
  }

  const Georeference& geo = scene.georeference;
  result["buildings"] = buildings;
  for (const std::string& what : scene.skipped) result["skipped"][what] = 1;
  result["triangles"] = triangles;
  for (const auto& [kind, ids] : lights) result["lights"][kind] = ids.size();
  if (!geo.crs.empty()) result["crs"] = geo.crs;
  Bounds placed;  // in the CRS: easting, northing, height
  if (bounds.min.x <= bounds.max.x) {
    placed.add(geo.from_model(bounds.min));
    placed.add(geo.from_model(bounds.max));
  }
  result["bbox"] = placed.to_json(3);
  result["bbox_model"] = bounds.to_json(3);
  result["origin"] = {geo.origin.x, geo.origin.y, geo.origin.z};
  result["vertices"] = vertices;
  result["triangles_shown"] = shown;  // every instance counted
  result["triangles_by_material"] = by_material;
  result["materials"] = scene.materials.size();
  result["meshes"] = scene.meshes.size();
  result["nodes"] = nodes;
  result["instances"] = instances;
  result["features"] = features;
  result["sources"] = geo.sources;
  result["licences"] = geo.licences;
  return result;
}

}  // namespace nightcity::nightbake
