#include "tools/georeference/similarity.h"

#include <cmath>

#include "formats/error.h"

namespace nightcity::georeference {

Similarity fit_similarity(std::span<const glm::dvec2> plane, std::span<const glm::dvec2> model,
                          double& residual_m) {
  if (plane.size() != model.size() || plane.size() < 2)
    throw Error("", "placing a model without CRS needs at least two control points");
  const double n = static_cast<double>(plane.size());
  glm::dvec2 p0{0, 0}, q0{0, 0};
  for (std::size_t i = 0; i < plane.size(); ++i) {
    p0 += plane[i] / n;
    q0 += model[i] / n;
  }
  double a = 0, b = 0, spread = 0;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const glm::dvec2 p = plane[i] - p0, q = model[i] - q0;
    a += p.x * q.x + p.y * q.y;
    b += p.x * q.y - p.y * q.x;
    spread += p.x * p.x + p.y * p.y;
  }
  Similarity fit;
  fit.a = a / spread;
  fit.b = b / spread;
  if (!std::isfinite(fit.a) || !std::isfinite(fit.b) || !(fit.a * fit.a + fit.b * fit.b > 0))
    throw Error("", "control points coincide or are not finite");
  fit.offset = {q0.x - (fit.a * p0.x - fit.b * p0.y), q0.y - (fit.b * p0.x + fit.a * p0.y)};
  double squares = 0;
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const glm::dvec2 d = fit.apply(plane[i]) - model[i];
    squares += d.x * d.x + d.y * d.y;
  }
  residual_m = std::sqrt(squares / n);
  return fit;
}

}  // namespace nightcity::georeference
