// Translation, rotation, scale: the parts glTF nodes and instances are made of.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace nightcity {

struct Trs {
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};  // w, x, y, z; unit
  glm::dvec3 scale{1};
};

/// T * R * S.
glm::dmat4 compose(const Trs& trs);

/// Empty where the matrix holds shear, projection, a zero scale or anything not finite. A mirrored matrix
/// gets a negative x scale.
std::optional<Trs> decompose(const glm::dmat4& matrix);

}  // namespace nightcity
