#include "runtime/scene/strongest_lights.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "formats/hierarchy/bounds.h"

namespace nightcity::scene {
namespace {

using hierarchy::Float4;

// A shader, whose rounding differs from ours, may confuse strengths whose ratio is below this.
constexpr float min_gap = 1.0001f;

}  // namespace

std::pair<float, float> find_cell_centre(const gpu::LightGridShape& shape, std::uint32_t x,
                                         std::uint32_t z) {
  return {shape.origin_x + (float(x) + 0.5f) * shape.cell_m,
          shape.origin_z + (float(z) + 0.5f) * shape.cell_m};
}

StrongestLights::StrongestLights(const std::vector<LightBins>& classes,
                                 const gpu::LightGridShape& shape, std::size_t listed)
    : classes_(classes), shape_(shape), listed_(listed) {
  for (const LightBins& bins : classes) bar_ = std::max(bar_, bins.max_strength(0));
}

std::span<const FoundLight> StrongestLights::find(std::uint32_t x, std::uint32_t z) {
  const auto [centre_x, centre_z] = find_cell_centre(shape_, x, z);
  while (!find_stronger(centre_x, centre_z) && count_ <= listed_)
    // As many lights more are found as the area grows, where they stand evenly.
    bar_ *= std::clamp(0.9f * float(count_) / float(listed_ + 1), 0.05f, 0.8f);
  // Also within the radius of the search, lights below the bar are not listed: there is no end to
  // how much fainter than the strongest of its class a light may be.
  outside_ = std::max(unseen_, bar_);
  if (count_ > listed_) {
    const auto last = found_.begin() + std::ptrdiff_t(listed_);
    std::nth_element(found_.begin(), last, found_.begin() + std::ptrdiff_t(count_),
                     std::greater<FoundLight>());
    count_ = listed_;
    outside_ = std::max(outside_, strength_of(*last));
    bar_ = 0.8f * strength_of(*last);  // the cell beside this one is much like it
  }
  leave_gap();
  return {found_.data(), count_};
}

// Finds all lights that are stronger than the bar in the cell with this centre, or those of them
// that are within the radius of the search. Returns whether a lower bar would find no more.
bool StrongestLights::find_stronger(float x, float z) {
  count_ = 0;
  unseen_ = 0;
  bool all = true;
  const float width_m = float(shape_.width) * shape_.cell_m,
              depth_m = float(shape_.depth) * shape_.cell_m,
              farthest = std::hypot(width_m, depth_m);
  for (const LightBins& bins : classes_) {
    float reach = bins.find_reach(bar_);
    all = all && reach >= std::min(farthest, bins.max_reach_m());
    if (reach > bins.max_reach_m() && farthest > bins.max_reach_m()) {
      reach = bins.max_reach_m();
      unseen_ = std::max(unseen_, bins.max_strength(reach));
    }
    if (reach >= 0)
      bins.for_each_near(x, z, std::min(reach, farthest),
                         [&](const LightRange& range) { add_stronger(range, x, z); });
  }
  return all;
}

// Strengths are rounded as in light_strength.
void StrongestLights::add_stronger(const LightRange& range, float centre_x, float centre_z) {
  if (found_.size() < count_ + range.count + 1) found_.resize(2 * (count_ + range.count + 1));
  const auto load = [](const float* from) {
    Float4 four;
    std::memcpy(&four, from, sizeof four);
    return four;
  };
  // Every light is written, and the next one over it if it is too weak: no branch to mispredict.
  FoundLight* to = found_.data() + count_;
  std::size_t i = 0;
  for (; i + 4 <= range.count; i += 4) {
    const Float4 dx = load(range.x + i) - centre_x, dz = load(range.z + i) - centre_z,
                 value = load(range.flux + i) / (dx * dx + dz * dz + shape_.softening_m2);
    if (!hierarchy::any_of(value > bar_)) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      *to = make_found(value[k], range.light[i + k]);
      to += value[k] > bar_;
    }
  }
  for (; i < range.count; ++i) {
    const float dx = range.x[i] - centre_x, dz = range.z[i] - centre_z,
                value = range.flux[i] / (dx * dx + dz * dz + shape_.softening_m2);
    *to = make_found(value, range.light[i]);
    to += value > bar_;
  }
  count_ = std::size_t(to - found_.data());
}

// Leaves out the lights that rounding could confuse with one that is left out.
void StrongestLights::leave_gap() {
  FoundLight* const found = found_.data();
  while (count_ > 0) {
    const std::size_t count = count_;
    FoundLight weakest = found[0];
    for (std::size_t i = 1; i < count; ++i) weakest = std::min(weakest, found[i]);
    weakest_ = strength_of(weakest);
    const float limit = outside_ * min_gap;
    if (weakest_ > limit) return;
    FoundLight strongest_out = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const FoundLight light = found[i];
      const bool stays = strength_of(light) > limit;
      found[kept] = light;
      kept += stays;
      strongest_out = std::max(strongest_out, stays ? 0 : light);
    }
    outside_ = std::max(outside_, strength_of(strongest_out));
    count_ = kept;
  }
}

}  // namespace nightcity::scene
