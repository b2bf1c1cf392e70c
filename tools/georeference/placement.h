// Where a model without CRS stands: a plane similarity fitted to control points.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string>

#include "tools/georeference/frame.h"

namespace nightcity {

/// Model x, y = offset + (a, b) as a complex factor times plane coordinates: rotation and one scale, no
/// shear.
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

/// Least-squares similarity from `plane` to `model`, at least two points each (Umeyama 1991, in two
/// dimensions). `residual_m`: root mean square distance left, in model units. Throws Error when the points
/// coincide or are not finite.
Similarity fit_similarity(std::span<const glm::dvec2> plane, std::span<const glm::dvec2> model,
                          double& residual_m);

}  // namespace nightcity
