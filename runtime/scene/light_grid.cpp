#include "runtime/scene/light_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/scene/alias_table.h"

namespace nightcity {
namespace {

constexpr float least_cell_m = 16.0f;
constexpr float most_cells = 65536.0f;
// Strengths nearer than this cannot be told apart by a shader whose rounding differs from ours.
constexpr float least_gap = 1.0001f;

// How far around a cell lights are looked for, in cells: a lamp 400 m off is never a place's own light.
constexpr int most_rings = 24;

struct Strength {
  float value;
  std::uint32_t light;
  bool operator<(const Strength& other) const {
    return value != other.value ? value > other.value : light < other.light;
  }
};

// Lights by the cell they stand over.
class Bins {
 public:
  Bins(std::span<const Light> lights, const gpu::LightGridShape& shape)
      : shape_(shape), starts_(shape.width * shape.depth + 1) {
    std::vector<std::uint32_t> cell(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
      if (!(lights[i].flux_lm > 0)) continue;
      const auto at = [&](float p, float origin, std::uint32_t count) {
        return std::min(static_cast<std::uint32_t>(std::max(0.0f, (p - origin) / shape.cell_m)), count - 1);
      };
      cell[i] = at(lights[i].position.z, shape.origin_z, shape.depth) * shape.width +
                at(lights[i].position.x, shape.origin_x, shape.width);
      ++starts_[cell[i] + 1];
      greatest_flux_ = std::max(greatest_flux_, lights[i].flux_lm);
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    order_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (lights[i].flux_lm > 0) order_[next[cell[i]]++] = static_cast<std::uint32_t>(i);
  }

  std::span<const std::uint32_t> at(int x, int z) const {
    if (x < 0 || z < 0 || x >= int(shape_.width) || z >= int(shape_.depth)) return {};
    const std::size_t c = std::size_t(z) * shape_.width + std::size_t(x);
    return std::span(order_).subspan(starts_[c], starts_[c + 1] - starts_[c]);
  }
  float greatest_flux() const { return greatest_flux_; }

 private:
  const gpu::LightGridShape& shape_;
  std::vector<std::uint32_t> starts_, order_;
  float greatest_flux_ = 0;
};

struct Strongest {
  std::vector<Strength> found;  // strongest first, at most one more than can be listed
  float unseen = 0;             // no light that is not in `found` is stronger than this, or than its last
};

// The strongest lights of a cell: rings of bins outwards until nothing farther could be among them.
Strongest strongest(std::span<const Light> lights, const Bins& bins, const gpu::LightGridShape& shape, int x,
                    int z) {
  std::vector<Strength> found;
  const int last_ring = int(std::max(shape.width, shape.depth));
  float unseen = 0;
  for (int ring = 0; ring <= last_ring; ++ring) {
    if (ring > most_rings) {
      const float beyond = (float(ring) - 0.5f) * shape.cell_m;
      unseen = bins.greatest_flux() / (beyond * beyond + shape.softening_m2);
      break;
    }
    const auto take = [&](int bx, int bz) {
      for (const std::uint32_t light : bins.at(bx, bz))
        found.push_back({local_strength(shape, std::uint32_t(x), std::uint32_t(z), lights[light]), light});
    };
    for (int dx = -ring; dx <= ring; ++dx) {
      take(x + dx, z - ring);
      if (ring > 0) take(x + dx, z + ring);
    }
    for (int dz = -ring + 1; dz < ring; ++dz) {
      take(x - ring, z + dz);
      take(x + ring, z + dz);
    }
    if (found.size() > LOCAL_LIGHTS) {
      std::nth_element(found.begin(), found.begin() + LOCAL_LIGHTS, found.end());
      found.resize(LOCAL_LIGHTS + 1);
      const float beyond =
          (float(ring) + 0.5f) * shape.cell_m;  // nothing in a later ring is nearer to the centre
      const float weakest = std::max_element(found.begin(), found.end())->value;
      if (bins.greatest_flux() / (beyond * beyond + shape.softening_m2) < weakest) break;
    }
  }
  std::erase_if(found, [&](const Strength& s) { return !(s.value > unseen * least_gap); });
  std::sort(found.begin(), found.end());
  return {std::move(found), unseen};
}

}  // namespace

float local_strength(const gpu::LightGridShape& shape, std::uint32_t cell_x, std::uint32_t cell_z,
                     const Light& light) {
  const float dx = light.position.x - (shape.origin_x + (float(cell_x) + 0.5f) * shape.cell_m);
  const float dz = light.position.z - (shape.origin_z + (float(cell_z) + 0.5f) * shape.cell_m);
  return light.flux_lm / (dx * dx + dz * dz + shape.softening_m2);
}

LightGrid build_light_grid(std::span<const Light> lights) {
  LightGrid grid;
  float lower_x = INFINITY, lower_z = INFINITY, upper_x = -INFINITY, upper_z = -INFINITY;
  for (const Light& light : lights) {
    if (!(light.flux_lm > 0)) continue;
    lower_x = std::min(lower_x, light.position.x);
    upper_x = std::max(upper_x, light.position.x);
    lower_z = std::min(lower_z, light.position.z);
    upper_z = std::max(upper_z, light.position.z);
  }
  if (!(lower_x <= upper_x)) return grid;  // no light shines: width 0 tells the shader

  gpu::LightGridShape& shape = grid.shape;
  const float extent_x = upper_x - lower_x, extent_z = upper_z - lower_z;
  shape.cell_m =
      std::max({least_cell_m, std::sqrt(extent_x / most_cells * extent_z), extent_x / 4096, extent_z / 4096});
  shape.origin_x = lower_x;
  shape.origin_z = lower_z;
  shape.width = static_cast<std::uint32_t>(extent_x / shape.cell_m) + 1;
  shape.depth = static_cast<std::uint32_t>(extent_z / shape.cell_m) + 1;
  shape.softening_m2 = shape.cell_m * shape.cell_m / 4;  // a lamp right above the cell's centre stays finite

  const Bins bins(lights, shape);
  grid.cells.reserve(std::size_t{shape.width} * shape.depth);
  for (std::uint32_t z = 0; z < shape.depth; ++z)
    for (std::uint32_t x = 0; x < shape.width; ++x) {
      const auto [found, unseen] = strongest(lights, bins, shape, int(x), int(z));
      std::size_t count = std::min<std::size_t>(found.size(), LOCAL_LIGHTS);
      while (count > 0 && count < found.size() && !(found[count - 1].value > found[count].value * least_gap))
        --count;
      const float outside = std::max(unseen, count < found.size() ? found[count].value : 0.0f);
      gpu::LightCell cell{};
      cell.first = static_cast<std::uint32_t>(grid.entries.size());
      cell.count = static_cast<std::uint32_t>(count);
      // Between the weakest inside and the strongest outside.
      cell.threshold = count > 0 ? std::sqrt(found[count - 1].value) * std::sqrt(outside) : 0.0f;
      std::vector<float> weights;
      double sum = 0;
      for (std::size_t i = 0; i < count; ++i) {
        weights.push_back(found[i].value);
        sum += double(found[i].value);
      }
      cell.strength_sum = static_cast<float>(sum);
      const std::vector<gpu::AliasEntry> alias = build_alias_table(weights);
      for (std::size_t i = 0; i < count; ++i)
        grid.entries.push_back({found[i].light, alias[i].keep, found[alias[i].alias].light});
      grid.cells.push_back(cell);
    }
  return grid;
}

}  // namespace nightcity
