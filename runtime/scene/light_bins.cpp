#include "runtime/scene/light_bins.h"

#include <array>

namespace nightcity::scene {
namespace {

// Lights are searched by classes of flux. Each class has four times the flux of the one below it
// and bins twice as wide, because the distance at which a light is strong enough to be listed grows
// with the square root of its flux. With one class for all, the search for windows would have to
// end where the strongest floodlight beyond could still outdo them, and their lists would be short.
// The median light is in class 0.
constexpr int max_classes = 5;

int class_of(float flux_lm, float median_lm) {
  const double fours = std::log2(double(flux_lm) / double(median_lm)) / 2;
  return std::clamp(int(std::floor(fours)), 0, max_classes - 1);
}

}  // namespace

LightBins::LightBins(std::span<const Light> lights, std::span<const float> flux_lm,
                     std::vector<std::uint32_t> members, const gpu::LightGridShape& shape,
                     float side_m)
    : shape_(shape), side_m_(side_m), order_(std::move(members)) {
  width_ = int(float(shape.width) * shape.cell_m / side_m) + 1;
  depth_ = int(float(shape.depth) * shape.cell_m / side_m) + 1;
  starts_.resize(std::size_t(width_) * std::size_t(depth_) + 1);
  const auto bin = [&](std::uint32_t light) {
    const glm::vec3& p = lights[light].position;
    return std::size_t(row(p.z)) * std::size_t(width_) + std::size_t(column(p.x));
  };
  for (const std::uint32_t light : order_) {
    ++starts_[bin(light) + 1];
    max_flux_ = std::max(max_flux_, flux_lm[light]);
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1), sorted(order_.size());
  for (const std::uint32_t light : order_) sorted[next[bin(light)]++] = light;
  order_ = std::move(sorted);
  for (const std::uint32_t light : order_) {
    x_.push_back(lights[light].position.x);
    z_.push_back(lights[light].position.z);
    flux_.push_back(flux_lm[light]);
  }
}

std::vector<LightBins> sort_into_bins(std::span<const Light> lights, std::span<const float> flux_lm,
                                      const gpu::LightGridShape& shape) {
  std::vector<float> flux;
  for (const float f : flux_lm)
    if (f > 0) flux.push_back(f);
  const auto median = flux.begin() + std::ptrdiff_t(flux.size() / 2);
  std::nth_element(flux.begin(), median, flux.end());
  std::array<std::vector<std::uint32_t>, max_classes> members;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (flux_lm[i] > 0)
      members[std::size_t(class_of(flux_lm[i], *median))].push_back(std::uint32_t(i));
  std::vector<LightBins> classes;
  for (int c = 0; c < max_classes; ++c)
    if (!members[std::size_t(c)].empty())
      classes.emplace_back(lights, flux_lm, std::move(members[std::size_t(c)]), shape,
                           shape.cell_m * float(1 << c));
  return classes;
}

}  // namespace nightcity::scene
