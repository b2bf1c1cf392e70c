// Places a model without CRS: a plane similarity fitted to control points.
#pragma once

#include <glm/vec2.hpp>
#include <span>

namespace nightcity::georeference {

/// Rotation and one scale without shear: model x, y = offset + (a, b) times plane coordinates, (a,
/// b) taken as a complex factor.
struct Similarity {
  glm::dvec2 offset{0, 0};
  double a = 1, b = 0;

  glm::dvec2 apply(const glm::dvec2& p) const {
    return {offset.x + a * p.x - b * p.y, offset.y + b * p.x + a * p.y};
  }
  glm::dvec2 invert(const glm::dvec2& q) const {
    const glm::dvec2 d = q - offset;
    const double n = a * a + b * b;
    return {(a * d.x + b * d.y) / n, (a * d.y - b * d.x) / n};
  }
};

/// Returns the least-squares similarity from `plane` to `model`, at least two points each (Umeyama
/// 1991, in two dimensions). `residual_m`: the root mean square distance left, in model units.
/// Throws Error when the points coincide or are not finite.
Similarity fit_similarity(std::span<const glm::dvec2> plane, std::span<const glm::dvec2> model,
                          double& residual_m);

}  // namespace nightcity::georeference
