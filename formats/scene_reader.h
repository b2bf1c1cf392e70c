// Reads scenes: city.glb, or any other glTF 2.0.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "formats/mapped_primitive.h"
#include "formats/scene.h"
#include "formats/scene_bytes.h"
#include "formats/stored_hierarchy.h"

namespace nightcity {

/// Reads a scene mesh by mesh, so that a program need not hold all of them. What it throws is an
/// Error with the file's name, as for read_scene.
class SceneFile {
 public:
  /// Reads all but the meshes.
  explicit SceneFile(const std::filesystem::path& path);
  ~SceneFile();

  /// Returns what was read. There are no meshes in it, and `materials` and `skipped` are complete
  /// after close() or finish() only.
  const Scene& scene() const;
  std::size_t mesh_count() const;
  /// Returns the hierarchies that the file holds of static triangles. Their arrays lie in it.
  const std::vector<StoredHierarchy>& hierarchies() const;
  /// Returns the triangles that a mesh has by its accessors, which hold no promise: a bound for
  /// what to reserve. It is never above the bytes of the file.
  std::size_t count_triangles(std::size_t mesh) const;

  /// Returns the corners of the box that a mesh fills in its own frame, by the bounds that its
  /// accessors state and that nothing has checked; nothing where they state none.
  std::optional<std::array<glm::vec3, 2>> find_bounds(std::size_t mesh) const;

  /// Returns which of the file's materials some mesh says that it uses. Those that were added when
  /// meshes were read are not among them.
  std::vector<bool> list_used_materials() const;

  /// Returns a mesh. `index` < mesh_count(). `mapped` gets where its primitives lie in the file.
  SceneMesh read_mesh(std::size_t index, MappedMesh* mapped = nullptr);
  /// Returns where the primitives of a mesh lie in the file, after read_mesh's checks, of which
  /// that of vertices may be left to the caller; nothing where some of them cannot be read in
  /// place, or are refused by read_mesh.
  std::optional<MappedMesh> map_mesh(std::size_t index, VertexCheck vertices = VertexCheck::now);
  /// Returns whether several threads may call read_mesh and map_mesh at once. Not where vertices
  /// have colours: the materials made of them are numbered in the order of the meshes that are
  /// read.
  bool reads_in_parallel() const;

  /// Call it after the last mesh: completes scene(), and keeps nothing else but the files, which it
  /// returns, since mapped primitives lie in them. The memory of the JSON goes back to the system
  /// in the background, until finish() at the latest.
  std::shared_ptr<const SceneBytes> close();

  /// Returns the scene, with the materials that the meshes read so far need and without meshes.
  Scene finish();

 private:
  struct Reading;
  std::unique_ptr<Reading> reading_;
};

/// Returns the scene in a .glb or .gltf file, ours or anybody's: with Draco, instancing, node
/// hierarchies, indices of 8, 16 or 32 bits or none. Throws Error if the file is missing, truncated
/// or no glTF, an index is out of range, or a position or matrix is not finite.
Scene read_scene(const std::filesystem::path& path);

/// Returns where the scene in a .glb or .gltf file lies, and its identity; as read_scene, without
/// the work on meshes. Throws Error.
Georeference read_scene_georeference(const std::filesystem::path& path);

}  // namespace nightcity
