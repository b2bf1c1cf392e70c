#include "formats/light_check.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "formats/finite.h"

namespace nightcity {
namespace {

// Loose enough for float directions, tight enough that a shader need not normalise.
bool unit(const glm::vec3& v) {
  return std::abs(glm::dot(v, v) - 1.0f) < 1e-3f;
}

std::optional<std::string> shape_fault(const Light& light) {
  if (!std::isfinite(light.radius) || !std::isfinite(light.half_height))
    return "size is not finite";
  switch (light_kind(light)) {
    case LightKind::sphere:
      if (light.radius < 0) return "radius is negative";
      return std::nullopt;
    case LightKind::rectangle:
      if (!(half_width(light) > 0 && light.half_height > 0)) return "rectangle has no area";
      return std::nullopt;
  }
  return "unknown kind " + std::to_string(uint(light_kind(light)));
}

}  // namespace

std::optional<std::string> light_fault(const Light& light, std::size_t profile_count) {
  if (auto fault = shape_fault(light)) return fault;
  if (!finite(light.position)) return "position is not finite";
  if (!(std::isfinite(light.flux_lm) && light.flux_lm > 0)) return "flux is not a positive number";
  if (light.flux_lm < min_flux_lm) return "flux is below 1e-30 lm";
  if (!finite(light.axis) || !unit(light.axis)) return "axis is not a unit vector";
  if (!finite(light.tangent) || !unit(light.tangent)) return "tangent is not a unit vector";
  if (std::abs(glm::dot(light.axis, light.tangent)) > 1e-3f)
    return "tangent is not perpendicular to the axis";
  if ((light.colour_rgb9e5 & 0x07FFFFFFu) == 0) return "colour is black";
  const uint profile = light_profile(light);
  if (profile != LIGHT_NO_PROFILE && profile >= profile_count)
    return "profile " + std::to_string(profile) + " of " + std::to_string(profile_count);
  return std::nullopt;
}

std::optional<std::string> profile_fault(const LightProfile& profile, std::size_t data_size) {
  if (profile.c_count < 1 || profile.gamma_count < 2) return "grid is too small";
  if (!(profile.extent_deg > 0 && profile.extent_deg <= 180))
    return "extent is not in (0, 180] degrees";
  // 65536 squared fits in 64 bits: no overflow below.
  if (profile.c_count > 65536 || profile.gamma_count > 65536) return "grid is too large";
  const std::size_t values = std::size_t{profile.c_count} * profile.gamma_count;
  if (profile.data_offset + values > data_size) return "data lies outside its section";
  return std::nullopt;
}

double integrate_profile(const LightProfile& profile, std::span<const float> data) {
  // Across C the interpolant is linear and wraps round, so the mean over the planes is exact.
  const auto mean = [&](std::size_t row) {
    double sum = 0;
    for (std::size_t c = 0; c < profile.c_count; ++c)
      sum += double{data[profile.data_offset + c * profile.gamma_count + row]};
    return sum / profile.c_count;
  };
  const double step = glm::radians(double{profile.extent_deg}) / (profile.gamma_count - 1.0);
  // The integral of a line times sin(gamma), where the line's values at the ends m - h and m + h
  // are f and g, is (f + g) sin(m) sin(h) + (g - f) cos(m) (sin(h) - h cos(h)) / h. Written so,
  // nothing cancels in beams of a millionth of a degree but the last bracket, which has a series.
  const double h = step / 2;
  const double bracket =
      h < 0.01 ? h * h / 3 * (1 - h * h / 10 * (1 - h * h / 28)) : std::sin(h) / h - std::cos(h);
  double integral = 0, f = mean(0);
  for (std::size_t row = 1; row < profile.gamma_count; ++row) {
    const double g = mean(row), m = step * (static_cast<double>(row) - 0.5);
    integral += (f + g) * std::sin(m) * std::sin(h) + (g - f) * std::cos(m) * bracket;
    f = g;
  }
  return 2 * glm::pi<double>() * integral;
}

std::optional<std::string> profile_integral_fault(const LightProfile& profile,
                                                  std::span<const float> data) {
  const double integral = integrate_profile(profile, data);
  if (std::abs(integral - 1) <= profile_integral_tolerance) return std::nullopt;
  return "integral over the sphere is " + std::to_string(integral) + ", not 1 within 0.5 %";
}

}  // namespace nightcity
