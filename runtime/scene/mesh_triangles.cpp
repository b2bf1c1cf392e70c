#include "runtime/scene/mesh_triangles.h"

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "formats/parallel.h"
#include "runtime/scene/bvh.h"
#include "runtime/scene/parts.h"

namespace nightcity::scene {
namespace {

std::size_t count_triangles(const SceneMesh& mesh) {
  std::size_t count = 0;
  for (const ScenePrimitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
  return count;
}

// As append_mesh, to anything that takes triangles.
template <class Triangles>
std::size_t convert_mesh(const SceneMesh& mesh, const glm::dmat4& m,
                         std::span<const std::uint32_t> light_numbers, Triangles& out) {
  std::size_t dropped = 0;
  std::vector<glm::vec3> positions;
  for (const ScenePrimitive& primitive : mesh.primitives) {
    positions.clear();
    for (const glm::vec3& p : primitive.positions) positions.emplace_back(m * glm::dvec4(p, 1.0));
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const std::uint32_t a = primitive.indices[i], b = primitive.indices[i + 1],
                          c = primitive.indices[i + 2];
      gpu::Triangle t{};
      t.v0 = positions[a];
      t.v1 = positions[b];
      t.v2 = positions[c];
      const glm::vec3 normal = glm::cross(t.v1 - t.v0, t.v2 - t.v0);
      if (!(glm::dot(normal, normal) > 0)) {
        ++dropped;
        continue;
      }
      t.material = primitive.triangle_materials.empty() ? primitive.material
                                                        : primitive.triangle_materials[i / 3];
      t.feature = primitive.feature_ids.empty() ? NO_HIT : primitive.feature_ids[a];
      t.light =
          primitive.light_ids.empty() ? NO_HIT : find_light(primitive.light_ids[a], light_numbers);
      if (t.light != left_out_light) out.push_back(t);
    }
  }
  return dropped;
}

// Takes the triangles of a mesh to where they belong, and those for which there is no room there
// elsewhere.
class TrianglePlace {
 public:
  explicit TrianglePlace(std::span<gpu::Triangle> room) : room_(room) {}
  void push_back(const gpu::Triangle& triangle) {
    if (used_ < room_.size())
      room_[used_++] = triangle;
    else
      beyond_.push_back(triangle);
  }
  std::span<const gpu::Triangle> used() const { return room_.first(used_); }
  std::span<const gpu::Triangle> beyond() const { return beyond_; }

 private:
  std::span<gpu::Triangle> room_;
  std::size_t used_ = 0;
  std::vector<gpu::Triangle> beyond_;  // of files whose accessors say too little
};

}  // namespace

MeshSource meshes_of(const Scene& scene) {
  MeshSource source;
  source.read = [&scene](std::uint32_t mesh) {
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
                        std::span<const std::uint32_t> light_numbers,
                        LargeVector<gpu::Triangle>& out) {
  return convert_mesh(mesh, to_scene, light_numbers, out);
}

std::size_t append_meshes(const std::vector<PlacedMesh>& placed, const MeshSource& meshes,
                          std::span<const std::uint32_t> light_numbers, unsigned threads,
                          LargeVector<gpu::Triangle>& out) {
  std::vector<TrianglePlace> places;
  const std::size_t first = out.size();
  std::size_t all = first;
  for (const PlacedMesh& m : placed) all += meshes.triangles.at(m.mesh);
  check_triangle_count(all);
  out.resize(all);
  std::span<gpu::Triangle> room = std::span(out).subspan(first);
  for (const PlacedMesh& m : placed) {
    const std::size_t count = meshes.triangles.at(m.mesh);
    places.emplace_back(room.first(count));
    room = room.subspan(count);
  }
  std::atomic<std::size_t> dropped = 0;
  run_parallel(placed.size(), meshes.in_parallel ? threads : 1, [&](std::size_t i) {
    dropped +=
        convert_mesh(*meshes.read(placed[i].mesh), placed[i].to_scene, light_numbers, places[i]);
  });
  gpu::Triangle* end = out.data() + first;
  for (const TrianglePlace& place : places) {
    if (place.used().data() != end) std::copy(place.used().begin(), place.used().end(), end);
    end += place.used().size();
  }
  out.resize(static_cast<std::size_t>(end - out.data()));
  for (const TrianglePlace& place : places)
    out.insert(out.end(), place.beyond().begin(), place.beyond().end());
  return dropped;
}

}  // namespace nightcity::scene
