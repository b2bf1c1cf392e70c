#include "runtime/scene/lit_lights.h"

namespace nightcity::scene {

LitLights lit_lights(std::span<const Light> lights, std::span<const LightFamily> families,
                     std::span<const Schedule> schedules, std::span<const std::uint32_t> switches,
                     double time_s, LightFamilies on) {
  LitLights lit;
  // Lights share schedules, so each schedule is looked up once.
  std::vector<bool> open(schedules.size());
  for (std::size_t i = 0; i < schedules.size(); ++i)
    open[i] = is_lit(schedules[i], switches, time_s);
  lit.steady = find_steady_span(schedules, switches, time_s);
  lit.bits.resize((lights.size() + 31) / 32);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const bool scheduled = lights[i].schedule < schedules.size();
    if (!(lights[i].flux_lm > 0) || (scheduled && !open[lights[i].schedule])) continue;
    if (on != all_families && !has_family(on, families[i])) continue;
    lit.bits[i / 32] |= 1u << (i % 32);
    lit.list.push_back(static_cast<std::uint32_t>(i));
    lit.flux_lm += double{lights[i].flux_lm};
  }
  return lit;
}

std::vector<float> flux_of(const LitLights& lit, std::span<const Light> lights) {
  std::vector<float> flux(lights.size());
  for (const std::uint32_t i : lit.list) flux[i] = lights[i].flux_lm;
  return flux;
}

}  // namespace nightcity::scene
