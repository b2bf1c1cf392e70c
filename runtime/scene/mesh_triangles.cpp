#include "runtime/scene/mesh_triangles.h"

#include <glm/vec3.hpp>
#include <mutex>
#include <optional>

#include "formats/hierarchy/static_geometry.h"
#include "formats/parallel.h"
#include "runtime/scene/bvh.h"
#include "runtime/scene/parts.h"
#include "runtime/scene/vertex_placing.h"

namespace nightcity::scene {
namespace {

std::size_t count_triangles(const SceneMesh& mesh) {
  std::size_t count = 0;
  for (const ScenePrimitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
  return count;
}

gpu::TextureCorners find_corners(const ScenePrimitive& primitive, std::size_t first_index) {
  const auto at = [&](std::size_t k) {
    return primitive.texture_coordinates[primitive.indices[first_index + k]];
  };
  return {at(0), at(1), at(2)};
}

// Calls `take` with the triangles of a primitive that have an area, lie within reach and whose
// light is not left out, and where their indices begin. Returns the number of those without area or
// beyond reach.
template <class Take>
std::size_t convert(const ScenePrimitive& primitive, const Placement& placement,
                    std::span<const std::uint32_t> light_numbers, std::vector<glm::vec3>& positions,
                    Take take) {
  std::size_t dropped = 0;
  positions.clear();
  for (const glm::vec3& p : primitive.positions)
    positions.push_back(hierarchy::place(placement.to_scene, p));
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const std::uint32_t a = primitive.indices[i], b = primitive.indices[i + 1],
                        c = primitive.indices[i + 2];
    gpu::Triangle t{};
    t.v0 = positions[a];
    t.v1 = positions[b];
    t.v2 = positions[c];
    if (!hierarchy::is_shown(t.v0, t.v1, t.v2)) {
      ++dropped;
      continue;
    }
    t.material = primitive.triangle_materials.empty() ? primitive.material
                                                      : primitive.triangle_materials[i / 3];
    t.feature = placement.feature;
    if (t.feature == NO_HIT && !primitive.feature_ids.empty()) t.feature = primitive.feature_ids[a];
    t.light = placement.light;
    if (t.light == NO_HIT && !primitive.light_ids.empty())
      t.light = find_light(primitive.light_ids[a], light_numbers);
    if (t.light != left_out_light) take(t, i);
  }
  return dropped;
}

// The triangles of a mesh: each primitive's in the file, or else stored.
struct Converted {
  MappedMesh mapped;
  std::vector<std::vector<gpu::Triangle>> stored;         // parallel to `mapped`
  std::vector<std::vector<gpu::TextureCorners>> corners;  // parallel to `stored`, or empty there
  std::size_t dropped = 0;

  void append_to(TriangleList& out, const std::vector<Placement>& placements) const {
    for (std::size_t i = 0; i < mapped.size(); ++i) {
      if (!mapped[i]) {
        out.append(stored[i], corners[i]);
        continue;
      }
      const auto primitive = std::make_shared<const MappedPrimitive>(*mapped[i]);
      for (const Placement& at : placements)
        out.append(primitive, at.to_scene, at.light, at.feature);
    }
  }
};

// Returns whether all triangles of a primitive are shown.
bool shows_all(const MappedPrimitive& primitive, const glm::dmat4& to_scene,
               std::vector<glm::vec3>& positions) {
  const VertexPlacing placing(to_scene);
  positions.resize(primitive.vertices);
  for (std::uint32_t i = 0; i < primitive.vertices; ++i) {
    const hierarchy::Float4 p = placing.place(primitive, i);
    positions[i] = {p[0], p[1], p[2]};
  }
  for (std::size_t i = 0; i < primitive.triangles; ++i) {
    const auto [a, b, c] = primitive.corners(i);
    if (!hierarchy::is_shown(positions[a], positions[b], positions[c])) return false;
  }
  return true;
}

// Returns a mesh that is read in place as a whole.
std::optional<Converted> map_mesh(const MeshSource& meshes, const PlacedMesh& placed,
                                  VertexCheck vertices) {
  if (!meshes.map) return std::nullopt;
  auto mapped = meshes.map(placed.mesh, vertices);
  if (!mapped) return std::nullopt;
  // A copy that is stored takes less memory than the note where a smaller one lies.
  constexpr std::uint32_t min_triangles_of_a_copy = 8;
  std::vector<glm::vec3> positions;
  for (const auto& primitive : *mapped)
    if (placed.placements.size() > 1 && primitive->triangles < min_triangles_of_a_copy)
      return std::nullopt;
  for (const auto& primitive : *mapped)
    for (const Placement& at : placed.placements)
      if (vertices == VertexCheck::now && !shows_all(*primitive, at.to_scene, positions))
        return std::nullopt;
  Converted result;
  result.mapped = std::move(*mapped);
  return result;
}

Converted convert_mesh(const MeshSource& meshes, const PlacedMesh& placed,
                       std::span<const std::uint32_t> light_numbers, VertexCheck vertices) {
  if (light_numbers.empty())
    if (auto mapped = map_mesh(meshes, placed, vertices)) return std::move(*mapped);
  const bool may_be_mapped = light_numbers.empty() && placed.placements.size() == 1;
  Converted result;
  const auto mesh = meshes.read(placed.mesh, &result.mapped);
  result.mapped.resize(mesh->primitives.size());
  result.stored.resize(mesh->primitives.size());
  result.corners.resize(mesh->primitives.size());
  std::vector<glm::vec3> positions;
  for (std::size_t i = 0; i < mesh->primitives.size(); ++i) {
    const ScenePrimitive& primitive = mesh->primitives[i];
    std::optional<MappedPrimitive>& mapped = result.mapped[i];
    if (mapped && may_be_mapped) {
      std::size_t kept = 0;
      convert(primitive, placed.placements[0], {}, positions,
              [&](const gpu::Triangle&, std::size_t) { ++kept; });
      if (kept == mapped->triangles) continue;  // none is without area
    }
    mapped.reset();
    for (const Placement& placement : placed.placements)
      result.dropped +=
          convert(primitive, placement, light_numbers, positions,
                  [&](const gpu::Triangle& triangle, std::size_t first_index) {
                    result.stored[i].push_back(triangle);
                    if (!primitive.texture_coordinates.empty())
                      result.corners[i].push_back(find_corners(primitive, first_index));
                  });
  }
  return result;
}

}  // namespace

MeshSource meshes_of(const Scene& scene) {
  MeshSource source;
  source.read = [&scene](std::uint32_t mesh, MappedMesh*) {
    return std::shared_ptr<const SceneMesh>(std::shared_ptr<void>(), &scene.meshes.at(mesh));
  };
  source.in_parallel = true;
  for (const SceneMesh& mesh : scene.meshes) {
    source.triangles.push_back(count_triangles(mesh));
    Box& bounds = source.bounds.emplace_back();
    for (const ScenePrimitive& primitive : mesh.primitives)
      for (const glm::vec3& p : primitive.positions) bounds.grow(p);
  }
  return source;
}

std::uint32_t find_light(std::uint32_t light, std::span<const std::uint32_t> numbers) {
  return light < numbers.size() ? numbers[light] : light;
}

std::size_t append_mesh(const SceneMesh& mesh, const glm::dmat4& to_scene,
                        std::span<const std::uint32_t> light_numbers, TriangleList& out) {
  std::size_t dropped = 0;
  std::vector<glm::vec3> positions;
  for (const ScenePrimitive& primitive : mesh.primitives)
    dropped +=
        convert(primitive, {to_scene}, light_numbers, positions,
                [&](const gpu::Triangle& triangle, std::size_t) { out.push_back(triangle); });
  return dropped;
}

std::size_t append_mesh(const MeshSource& meshes, std::uint32_t mesh, const glm::dmat4& to_scene,
                        std::span<const std::uint32_t> light_numbers, TriangleList& out) {
  const Converted converted =
      convert_mesh(meshes, {mesh, {{to_scene}}}, light_numbers, VertexCheck::now);
  converted.append_to(out, {{to_scene}});
  return converted.dropped;
}

std::size_t append_meshes(const std::vector<PlacedMesh>& placed, const MeshSource& meshes,
                          std::span<const std::uint32_t> light_numbers, unsigned threads,
                          TriangleList& out, VertexCheck vertices) {
  std::size_t all = out.size();
  for (const PlacedMesh& m : placed) all += meshes.triangles.at(m.mesh) * m.placements.size();
  check_triangle_count(all);
  std::mutex appending;
  std::vector<std::optional<Converted>> waiting(placed.size());
  std::size_t next = 0, dropped = 0;
  run_parallel(placed.size(), meshes.in_parallel ? threads : 1, [&](std::size_t i) {
    Converted converted = convert_mesh(meshes, placed[i], light_numbers, vertices);
    const std::lock_guard lock(appending);
    waiting[i] = std::move(converted);
    for (; next < waiting.size() && waiting[next]; ++next) {
      waiting[next]->append_to(out, placed[next].placements);
      dropped += waiting[next]->dropped;
      waiting[next].reset();
    }
  });
  return dropped;
}

}  // namespace nightcity::scene
