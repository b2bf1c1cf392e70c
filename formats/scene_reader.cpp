#include "formats/scene_reader.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <glm/common.hpp>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "formats/feature_table.h"
#include "formats/georeference_json.h"
#include "formats/gltf_accessor.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_document.h"
#include "formats/material_reader.h"
#include "formats/scene_node_reader.h"
#include "formats/scene_places_json.h"
#include "formats/scene_primitive_reader.h"
#include "formats/skipped_content.h"
#include "formats/stored_hierarchy_reader.h"
#include "formats/vertex_colours.h"

namespace nightcity {
namespace {

using gltf::extension;
using gltf::Json;
using gltf::member;

const Json& find_asset_extras(const gltf::Document& document) {
  return member(member(member(document.root(), "asset"), "extras"), gltf::extras_key);
}

class Reader {
 public:
  explicit Reader(gltf::Document& document)
      : document_(document),
        accessors_(document),
        materials_(document, accessors_),
        primitives_(accessors_) {}

  // Reads all but the meshes.
  void read() {
    check_required_extensions(document_);
    const Json& ours = find_asset_extras(document_);
    if (ours.is_object()) {
      scene_.georeference = georeference_from_json(ours);
      scene_.places = places_from_json(ours, place_sentences_);
    }
    read_features();
    read_materials();
    scene_.nodes = NodeReader(document_, accessors_, tables_).read();
    hierarchies_ = read_hierarchies(document_, accessors_, hierarchy_sentences_);
  }

  const Scene& scene() const { return scene_; }
  const std::vector<StoredHierarchy>& hierarchies() const { return hierarchies_; }
  SceneMesh read_mesh(std::size_t index, MappedMesh* mapped);
  std::optional<MappedMesh> map_mesh(std::size_t index);
  std::size_t count_triangles(std::size_t index) const;
  std::optional<std::array<glm::vec3, 2>> find_bounds(std::size_t index) const;
  bool has_colours() const;
  std::vector<bool> list_used_materials() const;

  // Adds what is known when all meshes have been read.
  void complete() {
    if (std::exchange(complete_, true)) return;
    add_coloured_materials();
    scene_.skipped = describe_skipped(document_, find_asset_extras(document_).is_object());
    if (const std::size_t count = untextured_)
      scene_.skipped.push_back(std::to_string(count) +
                               (count == 1 ? " primitive has" : " primitives have") +
                               " a texture and no texture coordinates: the mean colour is shown");
    for (auto* sentences :
         {&material_sentences_, &colour_sentences_, &place_sentences_, &hierarchy_sentences_})
      scene_.skipped.insert(scene_.skipped.end(), sentences->begin(), sentences->end());
  }
  Scene finish() {
    complete();
    return std::move(scene_);
  }

 private:
  void read_features();
  void read_materials();
  void add_coloured_materials();
  std::uint32_t find_material(const Json& source);

  const gltf::Document& document_;
  gltf::AccessorReader accessors_;
  MaterialReader materials_;
  PrimitiveReader primitives_;
  Scene scene_;
  std::vector<StoredHierarchy> hierarchies_;
  std::vector<FeatureRange> tables_;
  // The file's materials come first, then glTF's default one, then those of vertices' colours.
  std::size_t material_count_ = 0;  // of the file
  VertexColours colours_;
  std::atomic<bool> uses_default_ = false;
  std::atomic<std::size_t> untextured_ = 0;  // primitives without the coordinates for their texture
  bool complete_ = false;
  std::vector<std::string> material_sentences_, colour_sentences_, place_sentences_,
      hierarchy_sentences_;
};

void Reader::read_features() {
  const Json& metadata = extension(document_.root(), gltf::structural_metadata);
  const ViewBytes view = [this](std::size_t index) { return accessors_.view(index); };
  for (std::size_t t = 0; t < member(metadata, "propertyTables").size(); ++t) {
    const auto features = read_feature_table(metadata, t, view);
    tables_.push_back({scene_.features.size(), features.size()});
    scene_.features.insert(scene_.features.end(), features.begin(), features.end());
  }
}

void Reader::read_materials() {
  material_count_ = document_.count("materials");
  for (std::size_t i = 0; i < material_count_; ++i) scene_.materials.push_back(materials_.read(i));
  scene_.pictures = materials_.take_pictures();
  material_sentences_ = materials_.describe_skipped();
  // glTF's default: white, single-sided.
  scene_.materials.push_back({.name = "", .base_colour = glm::vec3(1), .double_sided = false});
}

std::uint32_t Reader::find_material(const Json& source) {
  const std::size_t index = gltf::index(source, "material").value_or(material_count_);
  if (index > material_count_ || (index == material_count_ && source.contains("material")))
    throw Error("", numbered("material", index), "is not there");
  if (index == material_count_) uses_default_ = true;
  return static_cast<std::uint32_t>(index);
}

void Reader::add_coloured_materials() {
  if (const std::size_t count = colours_.primitives()) {
    const auto made = colours_.materials(scene_.materials);
    scene_.materials.insert(scene_.materials.end(), made.begin(), made.end());
    colour_sentences_.push_back(std::to_string(count) +
                                (count == 1 ? " primitive has" : " primitives have") +
                                " colours of vertices, shown as one colour a triangle");
  } else if (!uses_default_) {
    scene_.materials.pop_back();
  }
}

SceneMesh Reader::read_mesh(std::size_t index, MappedMesh* mapped) {
  const Json& source = document_.element("meshes", index);
  const Json& primitives = member(source, "primitives");
  SceneMesh mesh;
  mesh.name = gltf::text(source, "name");
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    try {
      std::vector<glm::vec3> colours;
      auto primitive = primitives_.read(primitives.at(p), tables_, colours);
      if (!primitive) continue;
      primitive->material = find_material(primitives.at(p));
      colours_.apply(*primitive, colours, material_count_ + 1);
      if (primitive->indices.empty()) continue;
      if (const auto& texture = scene_.materials[primitive->material].texture) {
        primitive->texture_coordinates = primitives_.read_texture_coordinates(
            primitives.at(p), texture->coordinates, primitive->positions.size());
        untextured_ += primitive->texture_coordinates.empty();
      }
      if (mapped) {
        mapped->push_back(primitive->texture_coordinates.empty()
                              ? primitives_.find(primitives.at(p), tables_)
                              : std::nullopt);
        if (mapped->back()) mapped->back()->material = primitive->material;
      }
      mesh.primitives.push_back(std::move(*primitive));
    } catch (const Error& error) {
      throw Error("", numbered("mesh", index) + numbered(" primitive", p), error.what());
    }
  }
  return mesh;
}

std::optional<MappedMesh> Reader::map_mesh(std::size_t index) {
  MappedMesh mesh;
  for (const Json& source : member(document_.element("meshes", index), "primitives")) {
    auto primitive = primitives_.find(source, tables_);
    if (!primitive || !is_fit(*primitive)) return std::nullopt;
    primitive->material = find_material(source);
    if (scene_.materials[primitive->material].texture) return std::nullopt;
    mesh.push_back(primitive);
  }
  return mesh;
}

std::size_t Reader::count_triangles(std::size_t index) const {
  std::size_t count = 0;
  const Json& primitives = member(document_.element("meshes", index), "primitives");
  for (const Json& primitive : primitives) {
    auto accessor = gltf::index(primitive, "indices");
    if (!accessor) accessor = gltf::index(member(primitive, "attributes"), "POSITION");
    if (!accessor || *accessor >= document_.count("accessors")) continue;
    const std::size_t corners =
        gltf::index(document_.element("accessors", *accessor), "count").value_or(0);
    count += std::min(PrimitiveReader::count_triangles(primitive, corners), document_.bytes());
  }
  return std::min(count, document_.bytes());
}

std::vector<bool> Reader::list_used_materials() const {
  std::vector<bool> used(document_.count("materials"));
  for (std::size_t mesh = 0; mesh < document_.count("meshes"); ++mesh)
    for (const Json& primitive : member(document_.element("meshes", mesh), "primitives"))
      if (const auto material = gltf::index(primitive, "material");
          material && *material < used.size())
        used[*material] = true;
  return used;
}

std::optional<std::array<glm::vec3, 2>> Reader::find_bounds(std::size_t index) const {
  std::optional<std::array<glm::vec3, 2>> bounds;
  for (const Json& primitive : member(document_.element("meshes", index), "primitives")) {
    const auto accessor = gltf::index(member(primitive, "attributes"), "POSITION");
    if (!accessor || *accessor >= document_.count("accessors")) continue;
    const Json& positions = document_.element("accessors", *accessor);
    std::array<glm::vec3, 2> box{};
    const auto read = [&](const char* key, glm::vec3& corner) {
      const Json& values = member(positions, key);
      if (!values.is_array() || values.size() != 3) return false;
      for (int axis = 0; axis < 3; ++axis) {
        const Json& value = values.at(static_cast<std::size_t>(axis));
        if (!value.is_number()) return false;
        corner[axis] = value.get<float>();
      }
      return true;
    };
    if (!read("min", box[0]) || !read("max", box[1])) continue;
    bounds =
        bounds ? std::array{glm::min((*bounds)[0], box[0]), glm::max((*bounds)[1], box[1])} : box;
  }
  return bounds;
}

bool Reader::has_colours() const {
  for (std::size_t i = 0; i < document_.count("meshes"); ++i)
    for (const Json& primitive : member(document_.element("meshes", i), "primitives"))
      if (!member(member(primitive, "attributes"), gltf::colour_attribute).is_null()) return true;
  return false;
}

// Returns what `read` returns, with the file's name in front of each error.
template <class Read>
auto with_name(const std::filesystem::path& path, Read read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Error(path.string(), error.what());
  } catch (const std::bad_alloc&) {
    throw Error(path.string(), "asks for more memory than there is");
  } catch (const Json::exception& error) {
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
  Reader reader{document};
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
    reading_->in_parallel = !reading_->reader.has_colours();
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
  return with_name(reading_->path, [&] { return reading_->reader.count_triangles(mesh); });
}

std::vector<bool> SceneFile::list_used_materials() const {
  return with_name(reading_->path, [&] { return reading_->reader.list_used_materials(); });
}

std::optional<std::array<glm::vec3, 2>> SceneFile::find_bounds(std::size_t mesh) const {
  return with_name(reading_->path, [&] { return reading_->reader.find_bounds(mesh); });
}

SceneMesh SceneFile::read_mesh(std::size_t index, MappedMesh* mapped) {
  SceneMesh mesh =
      with_name(reading_->path, [&] { return reading_->reader.read_mesh(index, mapped); });
  reading_->release_pages_after(count_bytes(mesh));
  return mesh;
}

std::optional<MappedMesh> SceneFile::map_mesh(std::size_t index) {
  try {
    auto mesh = reading_->reader.map_mesh(index);
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
    const Json& ours = find_asset_extras(document);
    return ours.is_object() ? georeference_from_json(ours) : Georeference{};
  });
}

}  // namespace nightcity
