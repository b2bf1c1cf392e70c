#include "formats/scene_reader.h"

#include <malloc.h>

#include <atomic>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "formats/georeference_json.h"
#include "formats/gltf_document.h"
#include "formats/scene_document_reader.h"
#include "formats/stated_meshes.h"

namespace nightcity {
namespace {

// Returns what `read` returns, with the file's name in front of each error.
template <class Read>
auto with_name(const std::filesystem::path& path, Read read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Error(path.string(), error.what());
  } catch (const std::bad_alloc&) {
    throw Error(path.string(), "asks for more memory than there is");
  } catch (const gltf::Json::exception& error) {
    throw Error(path.string(), error.what());
  }
}

// Pages of a mapped file count as the program's memory once they are read, so they are given back
// whenever this many bytes were. The system keeps them as long as it has room.
constexpr std::size_t max_resident = std::size_t{8} << 20;

std::size_t count_bytes(const SceneMesh& mesh) {
  std::size_t bytes = 0;
  for (const ScenePrimitive& p : mesh.primitives)
    bytes += p.positions.size() * sizeof p.positions[0] + 4 * p.indices.size() +
             4 * p.feature_ids.size() + 4 * p.light_ids.size();
  return bytes;
}

std::size_t count_bytes(const MappedMesh& mesh) {
  std::size_t bytes = 0;
  for (const auto& primitive : mesh)
    bytes += primitive->vertices * (sizeof(glm::vec3) + 8) +
             3 * primitive->triangles * primitive->index_bytes;
  return bytes;
}

}  // namespace

struct SceneFile::Reading {
  std::filesystem::path path;
  gltf::Document document;
  DocumentReader reader{document};
  std::atomic<std::size_t> resident = 0;
  bool in_parallel = false;
  std::future<void> freeing{};  // of the JSON

  void release_pages_after(std::size_t bytes) {
    if ((resident += bytes) <= max_resident) return;
    resident = 0;
    document.release_pages();
  }
};

SceneFile::SceneFile(const std::filesystem::path& path)
    : reading_(new Reading{path, gltf::Document(path)}) {
  with_name(path, [&] {
    reading_->reader.read();
    reading_->in_parallel = !has_vertex_colours(reading_->document);
  });
}

SceneFile::~SceneFile() = default;

const Scene& SceneFile::scene() const {
  return reading_->reader.scene();
}
const std::vector<StoredHierarchy>& SceneFile::hierarchies() const {
  return reading_->reader.hierarchies();
}
std::size_t SceneFile::mesh_count() const {
  return reading_->document.count("meshes");
}
bool SceneFile::reads_in_parallel() const {
  return reading_->in_parallel;
}

std::size_t SceneFile::count_triangles(std::size_t mesh) const {
  return with_name(reading_->path,
                   [&] { return count_stated_triangles(reading_->document, mesh); });
}

std::vector<bool> SceneFile::list_used_materials() const {
  return with_name(reading_->path,
                   [&] { return nightcity::list_used_materials(reading_->document); });
}

std::optional<std::array<glm::vec3, 2>> SceneFile::find_bounds(std::size_t mesh) const {
  return with_name(reading_->path, [&] { return find_stated_bounds(reading_->document, mesh); });
}

SceneMesh SceneFile::read_mesh(std::size_t index, MappedMesh* mapped) {
  SceneMesh mesh =
      with_name(reading_->path, [&] { return reading_->reader.read_mesh(index, mapped); });
  reading_->release_pages_after(count_bytes(mesh));
  return mesh;
}

std::optional<MappedMesh> SceneFile::map_mesh(std::size_t index, VertexCheck vertices) {
  try {
    auto mesh = reading_->reader.map_mesh(index, vertices);
    if (mesh) reading_->release_pages_after(count_bytes(*mesh));
    return mesh;
  } catch (const std::exception&) {
    return std::nullopt;  // read_mesh says why
  }
}

std::shared_ptr<const SceneBytes> SceneFile::close() {
  return with_name(reading_->path, [&] {
    reading_->reader.complete();
    gltf::Json json;
    auto files = reading_->document.take_files(json);
    reading_->freeing = std::async(std::launch::async, [json = std::move(json)]() mutable {
      json = nullptr;
      // It was a million small pieces, which the C library would keep for others.
      ::malloc_trim(0);
    });
    return files;
  });
}

Scene SceneFile::finish() {
  if (reading_->freeing.valid()) reading_->freeing.get();
  return with_name(reading_->path, [&] { return reading_->reader.finish(); });
}

Scene read_scene(const std::filesystem::path& path) {
  SceneFile file(path);
  std::vector<SceneMesh> meshes;
  for (std::size_t i = 0; i < file.mesh_count(); ++i) meshes.push_back(file.read_mesh(i));
  Scene scene = file.finish();
  scene.meshes = std::move(meshes);
  return scene;
}

Georeference read_scene_georeference(const std::filesystem::path& path) {
  const gltf::Document document(path);
  return with_name(path, [&] {
    const gltf::Json& ours = find_asset_extras(document);
    return ours.is_object() ? georeference_from_json(ours) : Georeference{};
  });
}

}  // namespace nightcity
