#include "runtime/render/white.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "formats/colour.h"

namespace nightcity::render {
namespace {

// Columns, as GLM has them. ITU-R BT.709-6 with white D65.
const glm::dmat3 xyz_of_rec709(0.4123907993, 0.2126390059, 0.0193308187, 0.3575843394, 0.7151686788,
                               0.1191947798, 0.1804807884, 0.0721923154, 0.9505321522);
const glm::dmat3 cones_of_xyz(0.401288, -0.250268, -0.002079, 0.650173, 1.204414, 0.048952,
                              -0.051461, 0.045854, 0.953127);

}  // namespace

glm::mat3 adapt_to(const glm::vec3& white, double degree) {
  const glm::dmat3 cones = cones_of_xyz * xyz_of_rec709;
  const double luminance = double{tonemap::luminance_709(white.r, white.g, white.b)};
  const glm::dvec3 from = cones * (glm::dvec3(white) / luminance), to = cones * glm::dvec3(1);
  glm::dmat3 scale(0);
  for (int cone = 0; cone < 3; ++cone)
    // A cone that the white does not reach is not scaled beyond measure.
    scale[cone][cone] = degree * to[cone] / std::max(from[cone], 0.02 * to[cone]) + 1 - degree;
  return glm::mat3(glm::inverse(cones) * scale * cones);
}

double degree_of_adaptation(double luminance) {
  constexpr double dark_surround = 0.8;
  return dark_surround * (1 - std::exp((-luminance - 42) / 92) / 3.6);
}

glm::mat3 white_matrix(const DisplaySettings& display) {
  if (display.white_balance_k > 0)
    return adapt_to(rec709_from_xy(planckian_xy(double(display.white_balance_k))), 1);
  const glm::vec3& white = display.adapted_to;
  const float luminance = tonemap::luminance_709(white.r, white.g, white.b);
  if (!display.adapt_white || !(luminance > 0)) return glm::mat3(1);
  return adapt_to(white, degree_of_adaptation(double(luminance)));
}

}  // namespace nightcity::render
