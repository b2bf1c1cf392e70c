#include "tools/exports/light_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "formats/rgb9e5.h"

namespace nightcity::exports {
namespace {

std::string clock(uint seconds_since_noon) {
  const uint minutes = (seconds_since_noon / 60 + 12 * 60) % (24 * 60);
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

// IEC 61966-2-1.
float to_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

}  // namespace

std::string describe_hours(const LightFile& file, const Light& light) {
  if (light.schedule == LIGHT_ALWAYS_ON) return "always";
  const Schedule& schedule = file.schedules()[light.schedule];
  const auto switches = file.switches().subspan(schedule.first, schedule.count);
  std::string text;
  for (std::size_t i = 0; i < switches.size(); i += 2)
    text += (text.empty() ? "" : ", ") + clock(switches[i]) + "-" +
            (i + 1 < switches.size() ? clock(switches[i + 1]) : "12:00");
  return text.empty() ? "never" : text;
}

std::string describe_provenance(const LightProvenance& from) {
  return fmt::format("position {}, height {}, flux {}, colour {}, profile {}, schedule {}",
                     name_of(from.position), name_of(from.height), name_of(from.flux),
                     name_of(from.colour), name_of(from.profile), name_of(from.schedule));
}

std::string to_hex_colour(const Light& light) {
  const glm::vec3 colour = decode_rgb9e5(light.colour_rgb9e5);
  const float most = std::max({colour.x, colour.y, colour.z, 1e-6f});
  const auto byte = [&](float channel) {
    return static_cast<int>(std::lround(255 * to_srgb(std::clamp(channel / most, 0.0f, 1.0f))));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.x), byte(colour.y), byte(colour.z));
}

}  // namespace nightcity::exports
