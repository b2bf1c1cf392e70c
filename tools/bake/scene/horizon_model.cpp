#include "tools/bake/scene/horizon_model.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/terrain/horizon.h"

namespace nightcity::bake {
namespace {

constexpr std::size_t max_vertices = 1'000'000;

}  // namespace

HorizonReport add_horizon_model(SceneWriter& writer, const terrain::Outline& outline,
                                std::uint32_t material, const Georeference& georeference) {
  HorizonReport report;
  const std::vector<std::vector<glm::dvec3>> rings = outline.find_rings();
  report.rings = rings.size();
  std::size_t vertices = 0;
  for (const auto& ring : rings) vertices += ring.size();
  if (vertices > max_vertices) {
    report.left_out = "the ground's edge has over a million vertices";
    return report;
  }
  mesh::TriangleMesh surface;
  try {
    surface = terrain::make_horizon(rings);
  } catch (const Error&) {
    report.left_out = "the ground's edge crosses itself too often";
    return report;
  }
  report.triangles = surface.triangles.size();
  if (report.triangles == 0) return report;
  ScenePrimitive primitive;
  primitive.material = material;
  for (const glm::dvec3& p : surface.positions)
    primitive.positions.push_back(glm::vec3(georeference.to_model(p)));
  for (const mesh::MeshTriangle& triangle : surface.triangles)
    primitive.indices.insert(primitive.indices.end(), std::begin(triangle.vertex),
                             std::end(triangle.vertex));
  SceneNode node{"horizon",
                 "horizon",
                 writer.add_mesh({"horizon", {std::move(primitive)}}),
                 false,
                 {SceneInstance{}}};
  writer.add_node(node);
  return report;
}

}  // namespace nightcity::bake
