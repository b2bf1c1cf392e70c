// Translation, rotation and scale: the parts of a transform of a glTF node or instance.
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

/// Returns the matrix T * R * S.
glm::dmat4 compose(const Trs& trs);

/// Returns the parts of a matrix, or nothing if it holds shear, projection, a zero scale or a value
/// that is not finite. A mirrored matrix gets a negative x scale.
std::optional<Trs> decompose(const glm::dmat4& matrix);

}  // namespace nightcity
