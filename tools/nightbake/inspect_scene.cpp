#include <map>
#include <set>
#include <string>
#include <vector>

#include "formats/scene_reader.h"
#include "tools/nightbake/inspect.h"
#include "tools/nightbake/mesh_extent.h"

namespace nightcity::nightbake {

namespace {

// Counts of the meshes' content, made while they are read one by one.
struct MeshCounts {
  std::size_t triangles = 0, vertices = 0, shown = 0;
  std::map<std::uint32_t, std::size_t> by_material;
  Bounds bounds;
  std::map<std::string, std::set<std::uint32_t>> lights;  // by the kind of node that shows them
};

std::string kind_of(const SceneNode& node) {
  return node.kind.empty() ? "other" : node.kind;
}

void count_mesh(const SceneMesh& mesh, const std::vector<const SceneNode*>& nodes,
                MeshCounts& counts) {
  std::size_t triangles = 0;
  for (const ScenePrimitive& primitive : mesh.primitives) {
    triangles += primitive.indices.size() / 3;
    counts.vertices += primitive.positions.size();
    counts.by_material[primitive.material] += primitive.indices.size() / 3;
  }
  counts.triangles += triangles;
  const MeshExtent extent(mesh);
  std::set<std::string> kinds;  // of the nodes that show it
  for (const SceneNode* node : nodes) {
    counts.shown += triangles * node->instances.size();
    for (const SceneInstance& instance : node->instances) {
      const std::string kind = kind_of(*node);
      if (instance.light != no_id) counts.lights[kind].insert(instance.light);
      if (kind == "horizon") continue;  // no part of the scene's extent
      kinds.insert(kind);
      extent.add_copy(instance.to_model, counts.bounds);
    }
  }
  for (const std::string& kind : kinds)
    for (const ScenePrimitive& primitive : mesh.primitives)
      for (const std::uint32_t id : primitive.light_ids)
        if (id != no_id) counts.lights[kind].insert(id);
}

}  // namespace

Inspection inspect_scene(const std::filesystem::path& path) {
  Inspection result = make_empty_inspection("scene");
  SceneFile file(path);
  std::vector<std::vector<const SceneNode*>> nodes_of(file.mesh_count());
  for (const SceneNode& node : file.scene().nodes) nodes_of[node.mesh].push_back(&node);
  MeshCounts counts;
  for (std::size_t mesh = 0; mesh < nodes_of.size(); ++mesh)
    count_mesh(file.read_mesh(mesh), nodes_of[mesh], counts);
  const Scene scene = file.finish();
  std::map<std::string, std::size_t> by_material, nodes, features;
  for (const auto& [material, triangles] : counts.by_material)
    by_material[scene.materials.at(material).name] += triangles;
  std::size_t instances = 0;
  for (const SceneNode& node : scene.nodes) {
    ++nodes[kind_of(node)];
    instances += node.instances.size();
  }
  std::size_t buildings = 0;
  for (const SceneFeature& feature : scene.features) {
    ++features[feature.type.empty() ? "other" : feature.type];
    if (feature.type == "Building") ++buildings;
  }

  const Georeference& geo = scene.georeference;
  result["buildings"] = buildings;
  for (const std::string& what : scene.skipped) result["skipped"][what] = 1;
  result["triangles"] = counts.triangles;
  for (const auto& [kind, ids] : counts.lights)
    if (!ids.empty()) result["lights"][kind] = ids.size();
  if (!geo.crs.empty()) result["crs"] = geo.crs;
  Bounds placed;  // in the CRS: easting, northing, height
  if (const Bounds& bounds = counts.bounds; bounds.min.x <= bounds.max.x) {
    placed.add(geo.from_model(bounds.min));
    placed.add(geo.from_model(bounds.max));
  }
  result["bbox"] = placed.to_json(3);
  if (scene.places.geographic)
    if (const auto middle =
            to_degrees(*scene.places.geographic, glm::dvec2(0.5 * (placed.min + placed.max))))
      result["middle_latitude_longitude"] = {middle->x, middle->y};
  if (!scene.places.streets.empty()) result["named_streets"] = scene.places.streets.size();
  result["bbox_model"] = counts.bounds.to_json(3);
  result["origin"] = {geo.origin.x, geo.origin.y, geo.origin.z};
  result["vertices"] = counts.vertices;
  result["triangles_shown"] = counts.shown;  // every instance counted
  result["triangles_by_material"] = by_material;
  result["materials"] = scene.materials.size();
  result["meshes"] = nodes_of.size();
  result["nodes"] = nodes;
  result["instances"] = instances;
  result["features"] = features;
  result["sources"] = geo.sources;
  result["licences"] = geo.licences;
  return result;
}

}  // namespace nightcity::nightbake
