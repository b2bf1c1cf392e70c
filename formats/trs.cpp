#include "formats/trs.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace nightcity {

glm::dmat4 compose(const Trs& trs) {
  glm::dmat4 matrix = glm::mat4_cast(trs.rotation);
  for (int i = 0; i < 3; ++i) matrix[i] *= trs.scale[i];
  matrix[3] = glm::dvec4(trs.translation, 1);
  return matrix;
}

std::optional<Trs> decompose(const glm::dmat4& matrix) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(matrix[c][r])) return std::nullopt;
  if (matrix[0].w != 0 || matrix[1].w != 0 || matrix[2].w != 0 || matrix[3].w != 1)
    return std::nullopt;

  Trs trs;
  trs.translation = glm::dvec3(matrix[3]);
  glm::dmat3 axes(matrix);
  for (int i = 0; i < 3; ++i) {
    trs.scale[i] = glm::length(axes[i]);
    if (!(trs.scale[i] > 0)) return std::nullopt;
    axes[i] /= trs.scale[i];
  }
  // Axes in floats are perpendicular to the seventh digit only; visible shear is far above this.
  constexpr double tolerance = 1e-4;
  if (std::abs(glm::dot(axes[0], axes[1])) > tolerance ||
      std::abs(glm::dot(axes[1], axes[2])) > tolerance ||
      std::abs(glm::dot(axes[2], axes[0])) > tolerance)
    return std::nullopt;
  if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0) {
    axes[0] = -axes[0];
    trs.scale.x = -trs.scale.x;
  }
  trs.rotation = glm::normalize(glm::quat_cast(axes));
  return trs;
}

}  // namespace nightcity
