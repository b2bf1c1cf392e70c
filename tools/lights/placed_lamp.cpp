#include "tools/lights/placed_lamp.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "formats/rgb9e5.h"

namespace nightcity::lights {

Light to_light(const PlacedLamp& lamp, const Georeference& georeference, ScheduleTable& schedules) {
  const glm::dvec3 centre(lamp.foot.x + lamp.outreach.x, lamp.foot.y + lamp.outreach.y,
                          lamp.foot.z + lamp.mounting_height_m);
  // Model space: X east, Y up, Z south. The tilt turns axis and tangent together about a horizontal
  // line.
  const glm::dvec3 down(0, -1, 0), aim(lamp.aim.x, 0, -lamp.aim.y);
  const double c = std::cos(glm::radians(lamp.tilt_degrees)),
               s = std::sin(glm::radians(lamp.tilt_degrees));
  Light light{};
  light.position = glm::vec3(georeference.to_model(centre));
  light.radius = static_cast<float>(lamp.radius_m);
  light.axis = glm::normalize(glm::vec3(down * c + aim * s));
  light.tangent = glm::normalize(glm::vec3(aim * c - down * s));
  light.flux_lm = static_cast<float>(lamp.flux_lm);
  light.colour_rgb9e5 = encode_rgb9e5(lamp.colour);
  light.kind_profile = pack_kind_profile(LightKind::sphere, lamp.profile);
  light.schedule = lamp.hours ? schedules.add(*lamp.hours) : LIGHT_ALWAYS_ON;
  light.id = lamp.id;
  return light;
}

}  // namespace nightcity::lights
