// Turns a glTF document into a scene: what is in it besides meshes at once, and meshes one by one.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/feature_table.h"
#include "formats/gltf_accessor.h"
#include "formats/gltf_document.h"
#include "formats/mapped_primitive.h"
#include "formats/material_reader.h"
#include "formats/scene.h"
#include "formats/scene_primitive_reader.h"
#include "formats/stored_hierarchy.h"
#include "formats/vertex_colours.h"

namespace nightcity {

/// Returns what our writer has put into a document's asset; null in other documents.
const gltf::Json& find_asset_extras(const gltf::Document& document);

/// Errors that it throws name no file.
class DocumentReader {
 public:
  explicit DocumentReader(gltf::Document& document)
      : document_(document),
        accessors_(document),
        materials_(document, accessors_),
        primitives_(accessors_) {}

  /// Reads all but the meshes.
  void read();

  const Scene& scene() const { return scene_; }
  const std::vector<StoredHierarchy>& hierarchies() const { return hierarchies_; }
  SceneMesh read_mesh(std::size_t index, MappedMesh* mapped);
  std::optional<MappedMesh> map_mesh(std::size_t index, VertexCheck vertices);

  /// Adds what is known when all meshes have been read.
  void complete();
  Scene finish() {
    complete();
    return std::move(scene_);
  }

 private:
  void read_features();
  void read_materials();
  void add_coloured_materials();
  std::uint32_t find_material(const gltf::Json& source);

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

}  // namespace nightcity
