// The white that an eye or a camera is adapted to.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "runtime/render/settings.h"

namespace nightcity::render {

/// Returns the matrix from linear Rec. 709 light to the same as it looks to whoever is adapted to
/// `white` (Rec. 709, any luminance above 0), where `degree`, 0 .. 1, says how far: at 1, `white`
/// is shown as grey. The cones of CAT16 are scaled (Li et al.: Comprehensive color solutions:
/// CAM16, CAT16 and CAM16-UCS, 2017).
glm::mat3 adapt_to(const glm::vec3& white, double degree);

/// Returns the degree to which an eye in the dark adapts to the white of light of a mean luminance,
/// cd/m^2: CIECAM02's D with a dark surround (CIE 159:2004).
double degree_of_adaptation(double luminance);

/// Returns the matrix of the settings: complete adaptation to a black body's white of that
/// temperature, or the eye's to the scene; the unit matrix for neither.
glm::mat3 white_matrix(const DisplaySettings& display);

}  // namespace nightcity::render
