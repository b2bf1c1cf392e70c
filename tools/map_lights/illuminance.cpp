#include "tools/map_lights/illuminance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tools/lights/lighting_class.h"

namespace nightcity::map_lights {

double find_illuminance(const lights::PlacedLamp& lamp, const lights::Photometry& profile,
                        const TargetPoint& point) {
  const glm::dvec3 centre = lamp.foot + glm::dvec3(lamp.outreach, lamp.mounting_height_m);
  const glm::dvec3 ray = point.place - centre;
  const double distance = glm::length(ray);
  if (!(distance > 0)) return 0;
  const glm::dvec3 direction = ray / distance;
  const double incidence = -glm::dot(direction, point.normal);
  if (incidence <= 0) return 0;
  // As to_light turns axis and tangent.
  const glm::dvec3 down(0, 0, -1), aim(lamp.aim, 0);
  const double c = std::cos(glm::radians(lamp.tilt_degrees)),
               s = std::sin(glm::radians(lamp.tilt_degrees));
  const glm::dvec3 axis = down * c + aim * s, tangent = aim * c - down * s;
  const double gamma = std::acos(std::clamp(glm::dot(direction, axis), -1.0, 1.0));
  const double turn =
      std::atan2(glm::dot(direction, glm::cross(axis, tangent)), glm::dot(direction, tangent));
  return lamp.flux_lm * lights::intensity_at(profile, turn, gamma) * incidence /
         (distance * distance);
}

bool reach_mean(std::span<lights::PlacedLamp> lamps, const lights::Photometry& profile,
                std::span<const TargetPoint> points, double maintained_lx) {
  double sum = 0;
  for (lights::PlacedLamp& lamp : lamps) {
    lamp.flux_lm = 1;
    for (const TargetPoint& point : points) sum += find_illuminance(lamp, profile, point);
  }
  const double flux =
      maintained_lx * static_cast<double>(points.size()) / (lights::maintenance_factor * sum);
  if (!(flux > 0 && flux <= max_flux_lm)) return false;
  for (lights::PlacedLamp& lamp : lamps) lamp.flux_lm = flux;
  return true;
}

}  // namespace nightcity::map_lights
