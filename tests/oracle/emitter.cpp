#include "oracle/emitter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace nightcity::oracle {
namespace {

constexpr double pi = std::numbers::pi;

// SPEC.md 3.3, offset 48: 9-bit mantissas and a 5-bit exponent, scaled to luminance 1.
glm::dvec3 colour_of(std::uint32_t packed) {
  const double scale = std::ldexp(1.0, int(packed >> 27) - 24);
  const glm::dvec3 rgb(scale * double(packed & 511), scale * double(packed >> 9 & 511),
                       scale * double(packed >> 18 & 511));
  return rgb / (0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z);
}

// SPEC.md 3.4: candela towards unit `to`.
double intensity(const Lights& lights, const Light& light, const glm::dvec3& to) {
  const std::uint32_t index = light_profile(light);
  if (index == LIGHT_NO_PROFILE) return double(light.flux_lm) / (4 * pi);
  const LightProfile& profile = lights.profiles[index];
  const glm::dvec3 axis(light.axis), tangent(light.tangent);
  const double gamma_deg = std::acos(std::clamp(glm::dot(to, axis), -1.0, 1.0)) * 180 / pi;
  if (gamma_deg > double(profile.extent_deg)) return 0;
  double c_deg =
      std::atan2(glm::dot(to, glm::cross(axis, tangent)), glm::dot(to, tangent)) * 180 / pi;
  if (c_deg < 0) c_deg += 360;
  const auto value = [&](std::uint32_t c, std::uint32_t g) {
    return double(
        lights.profile_data[profile.data_offset + c % profile.c_count * profile.gamma_count + g]);
  };
  const double row = gamma_deg / double(profile.extent_deg) * (profile.gamma_count - 1);
  const double plane = c_deg / 360 * profile.c_count;
  const auto g = std::min(static_cast<std::uint32_t>(row), profile.gamma_count - 2);
  const auto c = static_cast<std::uint32_t>(plane);
  const double fg = row - g, fc = plane - c;
  return double(light.flux_lm) * ((1 - fc) * ((1 - fg) * value(c, g) + fg * value(c, g + 1)) +
                                  fc * ((1 - fg) * value(c + 1, g) + fg * value(c + 1, g + 1)));
}

struct Strata {
  int side;
  std::mt19937& random;
  // Calls visit(u, v) for one random point in each cell of a side x side grid.
  template <class Visit>
  void each(Visit&& visit) const {
    const auto jitter = [&] { return double(random()) / 4294967296.0; };
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const double u = (i + jitter()) / side, v = (j + jitter()) / side;
        visit(u, v);
      }
  }
};

// Samples by area over the cap that the receiver sees, where the shaders sample the cone of
// directions.
void append_sphere(const Lights& lights, const Light& light, const glm::dvec3& receiver,
                   const Strata& strata, std::vector<LightPoint>& out) {
  const glm::dvec3 centre(light.position), away = receiver - centre;
  const double distance = glm::length(away), radius = double(light.radius);
  if (distance <= radius) return;  // inside the lamp
  const glm::dvec3 axis = away / distance;
  const glm::dvec3 candela = colour_of(light.colour_rgb9e5) * intensity(lights, light, axis);
  if (radius == 0) {
    out.push_back({centre, candela / (distance * distance)});
    return;
  }
  const glm::dvec3 luminance = candela / (pi * radius * radius);
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 t = glm::normalize(glm::cross(axis, other)), b = glm::cross(axis, t);
  const double lowest = radius / distance;  // height of the cap's rim over the centre, in radii
  const double area = 2 * pi * radius * radius * (1 - lowest) / (strata.side * strata.side);
  strata.each([&](double u, double v) {
    const double height = 1 - u * (1 - lowest), phi = 2 * pi * v;
    const double across = std::sqrt(std::max(0.0, 1 - height * height));
    const glm::dvec3 normal = axis * height + (t * std::cos(phi) + b * std::sin(phi)) * across;
    const glm::dvec3 point = centre + radius * normal, to = receiver - point;
    const double d2 = glm::dot(to, to), cosine = glm::dot(normal, to) / std::sqrt(d2);
    if (cosine > 0) out.push_back({point, luminance * (area * cosine / d2)});
  });
}

void append_rectangle(const Light& light, const glm::dvec3& receiver, const Strata& strata,
                      std::vector<LightPoint>& out) {
  const glm::dvec3 centre(light.position), normal(light.axis), first(light.tangent);
  const glm::dvec3 second = glm::cross(normal, first);
  const double share = 1.0 / (strata.side * strata.side);
  if (glm::dot(normal, receiver - centre) <= 0) return;
  strata.each([&](double u, double v) {
    const glm::dvec3 point = centre + first * (double(half_width(light)) * (2 * u - 1)) +
                             second * (double(light.half_height) * (2 * v - 1));
    const glm::dvec3 to = receiver - point;
    const double d2 = glm::dot(to, to), cosine = glm::dot(normal, to) / std::sqrt(d2);
    if (cosine > 0)
      out.push_back({point, colour_of(light.colour_rgb9e5) *
                                (double(light.flux_lm) / pi * share * cosine / d2)});
  });
}

}  // namespace

void append_points(const Lights& lights, const Light& light, const glm::dvec3& receiver, int strata,
                   std::mt19937& random, std::vector<LightPoint>& out) {
  const Strata grid{strata, random};
  switch (light_kind(light)) {
    case LightKind::sphere:
      return append_sphere(lights, light, receiver, grid, out);
    case LightKind::rectangle:
      return append_rectangle(light, receiver, grid, out);
  }
}

glm::dvec3 seen_luminance(const Lights& lights, const Light& light, const glm::dvec3& to) {
  const glm::dvec3 colour = colour_of(light.colour_rgb9e5);
  switch (light_kind(light)) {
    case LightKind::sphere: {
      const double radius = double(light.radius);
      if (radius == 0) return glm::dvec3(0);  // a point has no surface to be seen
      return colour * (intensity(lights, light, to) / (pi * radius * radius));
    }
    case LightKind::rectangle: {
      const double area = 4 * double(half_width(light)) * double(light.half_height);
      const bool front = glm::dot(glm::dvec3(light.axis), to) > 0;
      return colour * (front ? double(light.flux_lm) / (pi * area) : 0.0);
    }
  }
  return glm::dvec3(0);
}

}  // namespace nightcity::oracle
