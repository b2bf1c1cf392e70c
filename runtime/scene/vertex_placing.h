// Places the vertices of a mapped primitive in the scene.
#pragma once

#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <memory>

#include "formats/hierarchy/bounds.h"
#include "formats/hierarchy/static_geometry.h"
#include "formats/mapped_primitive.h"

namespace nightcity::scene {

class VertexPlacing {
 public:
  VertexPlacing() = default;
  /// `to_scene` leads from the primitive's frame to that of the scene. Most only shift.
  explicit VertexPlacing(const glm::dmat4& to_scene) {
    const glm::vec3 shift(to_scene[3]);
    if (glm::translate(glm::dmat4(1), glm::dvec3(shift)) == to_scene)
      shift_ = hierarchy::to_float4(shift);
    else
      to_scene_ = std::make_shared<const glm::dmat4>(to_scene);
  }

  /// Returns a vertex where it stands, as hierarchy::place does.
  hierarchy::Float4 place(const MappedPrimitive& primitive, std::uint32_t vertex) const {
    // A sum of two floats that is made of doubles and rounded is the one that is made of floats,
    // because a double has more than twice as many digits (Figueroa, SIGNUM Newsletter 1995).
    return to_scene_
               ? hierarchy::to_float4(hierarchy::place(*to_scene_, primitive.position(vertex)))
               : hierarchy::load_vec3(primitive.position_place(vertex)) + shift_;
  }

 private:
  std::shared_ptr<const glm::dmat4> to_scene_;  // null: `shift_` alone
  hierarchy::Float4 shift_{};
};

}  // namespace nightcity::scene
