// Colours of vertices (COLOR_0) as materials of triangles: the renderer has one colour for each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "formats/scene.h"

namespace nightcity {

/// Makes materials for triangles whose corners have colours. A triangle gets the mean of its
/// corners' colours times its primitive's base colour. Triangles whose means are alike to 1/64 of
/// sRGB's range in each channel share a material, which has the mean of theirs.
class VertexColours {
 public:
  /// Sets `primitive.triangle_materials` to numbers from `first` on, in the order of materials().
  /// `colours` has one linear colour for each vertex; white ones change nothing.
  void apply(ScenePrimitive& primitive, const std::vector<glm::vec3>& colours, std::size_t first);

  /// Returns the materials that were made from those of the file.
  std::vector<SceneMaterial> materials(const std::vector<SceneMaterial>& of_file) const;

  /// Returns how many primitives have colours.
  std::size_t primitives() const { return primitives_; }

 private:
  struct Bin {
    std::uint32_t base;  // material of the primitive
    glm::dvec3 sum;
    std::size_t triangles;
  };
  std::unordered_map<std::uint64_t, std::uint32_t> places_;  // in bins_
  std::vector<Bin> bins_;
  std::size_t primitives_ = 0;
};

}  // namespace nightcity
