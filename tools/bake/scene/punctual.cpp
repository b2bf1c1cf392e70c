#include "tools/bake/scene/punctual.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/rgb9e5.h"

namespace nightcity::bake {
namespace {

using std::numbers::pi;

constexpr double max_spot_rad = pi / 2 - 1e-3;  // the extension ends at a right angle

// Returns the angle from the axis within which `share` of a profile's flux lies.
double find_angle_with(double share, const LightProfile& profile, std::span<const float> data) {
  const std::size_t count = profile.gamma_count;
  const double step = double{profile.extent_deg} * pi / 180 / static_cast<double>(count - 1);
  std::vector<double> flux(count, 0.0);  // up to each row
  for (std::size_t g = 1; g < count; ++g) {
    double mean = 0;
    for (std::size_t c = 0; c < profile.c_count; ++c)
      for (const std::size_t row : {g - 1, g})
        mean += double{data[profile.data_offset + c * count + row]} / (2.0 * profile.c_count);
    const double a = step * static_cast<double>(g - 1), b = a + step;
    flux[g] = flux[g - 1] + 2 * pi * mean * (std::cos(a) - std::cos(b));
  }
  const auto row = std::lower_bound(flux.begin(), flux.end(), share * flux.back()) - flux.begin();
  return step * static_cast<double>(row);
}

bool fainter(const std::pair<std::size_t, Light>& a, const std::pair<std::size_t, Light>& b) {
  if (a.second.flux_lm != b.second.flux_lm) return a.second.flux_lm < b.second.flux_lm;
  return a.first > b.first;
}
bool brighter(const std::pair<std::size_t, Light>& a, const std::pair<std::size_t, Light>& b) {
  return fainter(b, a);
}

}  // namespace

double find_spot_solid_angle(double inner_rad, double outer_rad) {
  const double inner = std::cos(inner_rad), outer = std::cos(outer_rad);
  return 2 * pi * (1 - inner + (inner - outer) / 3);
}

ScenePunctual to_punctual(const Light& light, std::span<const LightProfile> profiles,
                          std::span<const float> profile_data) {
  ScenePunctual result;
  result.position = light.position;
  result.direction = light.axis;
  result.colour = decode_rgb9e5(light.colour_rgb9e5);
  const double flux = double{light.flux_lm};
  switch (light_kind(light)) {
    case LightKind::rectangle:
      result.outer_rad = max_spot_rad;
      result.inner_rad = std::acos(0.75);  // makes the falloff's integral pi
      break;
    case LightKind::sphere: {
      const uint profile = light_profile(light);
      if (profile == LIGHT_NO_PROFILE) break;
      const double wide = find_angle_with(0.99, profiles[profile], profile_data);
      if (wide > pi / 2 + 1e-9) break;
      result.outer_rad = std::clamp(wide, 0.01, max_spot_rad);
      result.inner_rad = 0.8 * result.outer_rad;
      break;
    }
  }
  result.intensity_cd =
      flux /
      (result.outer_rad > 0 ? find_spot_solid_angle(result.inner_rad, result.outer_rad) : 4 * pi);
  return result;
}

void BrightestLights::add(const Light& light) {
  if (max_lights_ == 0) return;
  heap_.emplace_back(count_++, light);
  std::push_heap(heap_.begin(), heap_.end(), brighter);
  if (heap_.size() <= max_lights_) return;
  std::pop_heap(heap_.begin(), heap_.end(), brighter);
  heap_.pop_back();
}

std::vector<Light> BrightestLights::take() && {
  std::sort(heap_.begin(), heap_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Light> lights;
  for (const auto& [number, light] : heap_) lights.push_back(light);
  return lights;
}

}  // namespace nightcity::bake
