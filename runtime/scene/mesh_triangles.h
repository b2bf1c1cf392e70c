// From the meshes of a scene file to triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formats/scene.h"
#include "formats/stored_hierarchy.h"
#include "runtime/scene/render_scene.h"
#include "runtime/scene/triangle_list.h"

namespace nightcity::scene {

/// The meshes of a scene, one at a time, so that not all of them need be in memory.
struct MeshSource {
  /// `mapped`, where it is not null, gets where the mesh's primitives lie in the file, or stays
  /// empty.
  std::function<std::shared_ptr<const SceneMesh>(std::uint32_t mesh, MappedMesh* mapped)> read;
  /// Returns where all primitives of a mesh lie in the file, checked as `read` does but for
  /// vertices that are to be looked at later, nothing where `read` must be called. It may be
  /// absent.
  std::function<std::optional<MappedMesh>(std::uint32_t mesh, VertexCheck vertices)> map{};
  /// Called when every mesh has been read, as often as it is needed: `read` is not called again.
  std::function<void()> close;
  bool in_parallel = false;  // `read` and `map` may be called by several threads at the same time
  std::vector<std::size_t> triangles;          // of each mesh, as far as is known before it is read
  std::vector<Box> bounds;                     // the same of their boxes, in the meshes' own frames
  std::vector<StoredHierarchy> hierarchies{};  // those that a file holds of static triangles
};

/// Returns the meshes that `scene` holds, which must outlive the result.
MeshSource meshes_of(const Scene& scene);

/// Returns the new number of a light that geometry refers to (leave_out_lights); its own where
/// `numbers` has none.
std::uint32_t find_light(std::uint32_t light, std::span<const std::uint32_t> numbers);

/// Appends the triangles of a mesh that have an area and whose light is not left out, and returns
/// the number of those without area. `to_scene` leads from the mesh's frame to that of the
/// triangles.
std::size_t append_mesh(const SceneMesh& mesh, const glm::dmat4& to_scene,
                        std::span<const std::uint32_t> light_numbers, TriangleList& out);

/// The same for a mesh of a source. Primitives that can be read in place, and of which nothing is
/// left out, are not stored.
std::size_t append_mesh(const MeshSource& meshes, std::uint32_t mesh, const glm::dmat4& to_scene,
                        std::span<const std::uint32_t> light_numbers, TriangleList& out);

/// A place of a mesh, the light whose luminous surface the mesh is there, and the object that it
/// is; NO_HIT: its triangles' own hold.
struct Placement {
  glm::dmat4 to_scene;
  std::uint32_t light = NO_HIT, feature = NO_HIT;
};

/// A mesh whose triangles are stored for each of its placements, of which there is at least one.
struct PlacedMesh {
  std::uint32_t mesh;
  std::vector<Placement> placements;
};

/// Appends the triangles of `placed` in its order, and returns the number of those without area.
/// Those that are mapped may hold some that are not shown, if vertices are looked at later.
/// Each mesh is read by one of the threads. Throws Error if the scene cannot have as many.
std::size_t append_meshes(const std::vector<PlacedMesh>& placed, const MeshSource& meshes,
                          std::span<const std::uint32_t> light_numbers, unsigned threads,
                          TriangleList& out, VertexCheck vertices = VertexCheck::now);

}  // namespace nightcity::scene
