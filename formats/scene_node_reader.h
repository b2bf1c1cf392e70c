// Reads the nodes of glTF documents: where meshes are placed.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/gltf_accessor.h"
#include "formats/gltf_document.h"
#include "formats/scene.h"
#include "formats/scene_primitive_reader.h"

namespace nightcity {

/// Returns "mesh 3" for ("mesh", 3).
inline std::string numbered(const char* what, std::size_t number) {
  return what + (" " + std::to_string(number));
}

class NodeReader {
 public:
  /// `tables` are the file's property tables.
  NodeReader(const gltf::Document& document, const gltf::AccessorReader& accessors,
             const std::vector<FeatureRange>& tables)
      : document_(document), accessors_(accessors), tables_(tables) {}

  /// Returns the nodes with a mesh below the default scene, with their matrices to model space.
  /// Throws Error, without a file name, if a mesh is not there, a node is reached twice or a matrix
  /// is not finite.
  std::vector<SceneNode> read() const;

 private:
  std::vector<std::size_t> find_roots() const;
  std::optional<SceneNode> read_node(const gltf::Json& node, const glm::dmat4& to_model) const;
  std::vector<SceneInstance> read_instances(const gltf::Json& node,
                                            const glm::dmat4& to_model) const;

  const gltf::Document& document_;
  const gltf::AccessorReader& accessors_;
  const std::vector<FeatureRange>& tables_;
};

}  // namespace nightcity
