#include "runtime/scene/light_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include "formats/parallel.h"
#include "runtime/scene/alias_table.h"
#include "runtime/scene/bounds.h"

namespace nightcity::scene {
namespace {

constexpr float max_entries = 16777216.0f;  // in the lists of all cells
// A shader, whose rounding differs from ours, may confuse strengths whose ratio is below this.
constexpr float min_gap = 1.0001f;

// The radius of the search for lights around a cell, in bins of their class.
constexpr int max_rings = 24;

// Lights are searched by classes of flux. Each class has four times the flux of the one below it
// and bins twice as wide, because the distance at which a light is strong enough to be listed grows
// with the square root of its flux. With one class for all, the search for windows would have to
// end where the strongest floodlight beyond could still outdo them, and their lists would be short.
// The median light is in class 0.
constexpr int max_classes = 5;

std::pair<float, float> cell_centre(const gpu::LightGridShape& shape, std::uint32_t x,
                                    std::uint32_t z) {
  return {shape.origin_x + (float(x) + 0.5f) * shape.cell_m,
          shape.origin_z + (float(z) + 0.5f) * shape.cell_m};
}

struct Strength {
  float value;
  std::uint32_t light;
  bool operator<(const Strength& other) const {
    return value != other.value ? value > other.value : light < other.light;
  }
};

int class_of(float flux_lm, float median_lm) {
  const double fours = std::log2(double(flux_lm) / double(median_lm)) / 2;
  return std::clamp(int(std::floor(fours)), 0, max_classes - 1);
}

// Lights in the order of their bins, each property in an array of its own, so that four at a time
// are looked at.
struct LightRange {
  const float *x, *z, *flux;
  const std::uint32_t* light;
  std::size_t count;
};

// The lights of one class, sorted into square bins of the map.
class Bins {
 public:
  Bins(std::span<const Light> lights, std::span<const float> flux_lm,
       std::vector<std::uint32_t> members, const gpu::LightGridShape& shape, float side_m)
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

  int column(float x) const { return place(x - shape_.origin_x, width_); }
  int row(float z) const { return place(z - shape_.origin_z, depth_); }
  int rings() const { return std::max(width_, depth_); }
  float max_flux() const { return max_flux_; }

  // Returns an upper bound of a light's strength for a place in some bin, if the light is in none
  // of the rings around that bin up to this one.
  float strength_beyond(int ring) const {
    const float beyond = float(ring) * side_m_;
    return max_flux_ / (beyond * beyond + shape_.softening_m2);
  }

  // Returns the lights of the bins x0 <= x <= x1 in a row, those of them that exist.
  LightRange at(int x0, int x1, int z) const {
    x0 = std::max(x0, 0);
    x1 = std::min(x1, width_ - 1);
    if (x0 > x1 || z < 0 || z >= depth_) return {};
    const std::size_t row = std::size_t(z) * std::size_t(width_),
                      first = starts_[row + std::size_t(x0)],
                      end = starts_[row + std::size_t(x1) + 1];
    return {&x_[first], &z_[first], &flux_[first], &order_[first], end - first};
  }

 private:
  int place(float along, int count) const {
    return std::clamp(int(std::max(0.0f, along / side_m_)), 0, count - 1);
  }

  const gpu::LightGridShape& shape_;
  float side_m_;
  int width_, depth_;
  std::vector<std::uint32_t> starts_, order_;
  std::vector<float> x_, z_, flux_;  // of the lights, in the order of order_
  float max_flux_ = 0;
};

// Returns all lights that shine, class by class.
std::vector<Bins> by_class(std::span<const Light> lights, std::span<const float> flux_lm,
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
  std::vector<Bins> classes;
  for (int c = 0; c < max_classes; ++c)
    if (!members[std::size_t(c)].empty())
      classes.emplace_back(lights, flux_lm, std::move(members[std::size_t(c)]), shape,
                           shape.cell_m * float(1 << c));
  return classes;
}

// Calls `use(strength, light)` for every light that is stronger than `bar` in the cell with this
// centre. Strengths are rounded as in light_strength.
template <class Use>
void for_stronger(const LightRange& range, const gpu::LightGridShape& shape, float centre_x,
                  float centre_z, const float& bar, Use use) {
  const auto load = [](const float* from) {
    Float4 four;
    std::memcpy(&four, from, sizeof four);
    return four;
  };
  std::size_t i = 0;
  for (; i + 4 <= range.count; i += 4) {
    const Float4 dx = load(range.x + i) - centre_x, dz = load(range.z + i) - centre_z,
                 value = load(range.flux + i) / (dx * dx + dz * dz + shape.softening_m2);
    const auto stronger = value > Float4{bar, bar, bar, bar};
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(stronger);
    if ((halves[0] | halves[1]) == 0) continue;
    for (std::size_t k = 0; k < 4; ++k)
      if (value[k] > bar) use(value[k], range.light[i + k]);
  }
  for (; i < range.count; ++i) {
    const float dx = range.x[i] - centre_x, dz = range.z[i] - centre_z,
                value = range.flux[i] / (dx * dx + dz * dz + shape.softening_m2);
    if (value > bar) use(value, range.light[i]);
  }
}

struct Strongest {
  std::vector<Strength> found;  // strongest first, at most one more than can be listed
  // An upper bound of the lights that are not in `found`, where they are weaker than its last.
  float unseen = 0;
};

// Finds the strongest lights of a cell. In each class it searches rings of bins outwards, until
// nothing farther could be among them.
Strongest strongest(const std::vector<Bins>& classes, const gpu::LightGridShape& shape,
                    std::size_t listed, std::uint32_t x, std::uint32_t z) {
  Strongest cell;
  std::vector<Strength>& found = cell.found;
  // Lights weaker than this no longer matter. It is raised whenever half as many again have been
  // found.
  float bar = 0;
  const auto keep_strongest = [&] {
    const auto last = found.begin() + std::ptrdiff_t(listed);
    std::nth_element(found.begin(), last, found.end());
    bar = last->value;
    found.erase(last + 1, found.end());
  };
  const auto [centre_x, centre_z] = cell_centre(shape, x, z);
  for (const Bins& bins : classes) {
    const int column = bins.column(centre_x), row = bins.row(centre_z);
    for (int ring = 0; ring <= bins.rings(); ++ring) {
      if (ring > max_rings) {
        cell.unseen = std::max(cell.unseen, bins.strength_beyond(ring - 1));
        break;
      }
      const auto take = [&](int x0, int x1, int bz) {
        for_stronger(bins.at(x0, x1, bz), shape, centre_x, centre_z, bar,
                     [&](float value, std::uint32_t light) {
                       found.push_back({value, light});
                     });
      };
      take(column - ring, column + ring, row - ring);
      for (int dz = -ring + 1; dz < ring; ++dz) {
        take(column - ring, column - ring, row + dz);
        take(column + ring, column + ring, row + dz);
      }
      if (ring > 0) take(column - ring, column + ring, row + ring);
      if (found.size() > (bar > 0 ? listed + listed / 2 : listed)) keep_strongest();
      if (bins.strength_beyond(ring) < bar) break;
    }
  }
  if (found.size() > listed) keep_strongest();
  std::erase_if(found, [&](const Strength& s) { return !(s.value > cell.unseen * min_gap); });
  std::sort(found.begin(), found.end());
  return cell;
}

// A row of cells and their lists; entries count from the row's first.
struct Row {
  std::vector<gpu::LightCell> cells;
  std::vector<gpu::GridEntry> entries;
};

void add_cell(Row& row, const Strongest& strongest, std::size_t listed) {
  const auto& [found, unseen] = strongest;
  std::size_t count = std::min(found.size(), listed);
  while (count > 0 && count < found.size() &&
         !(found[count - 1].value > found[count].value * min_gap))
    --count;
  const float outside = std::max(unseen, count < found.size() ? found[count].value : 0.0f);
  gpu::LightCell cell{};
  cell.first = static_cast<std::uint32_t>(row.entries.size());
  cell.count = static_cast<std::uint32_t>(count);
  // The threshold lies between the weakest light inside and the strongest outside.
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
    row.entries.push_back({found[i].light, alias[i].keep, found[alias[i].alias].light});
  row.cells.push_back(cell);
}

}  // namespace

float light_strength(const gpu::LightGridShape& shape, std::uint32_t cell_x, std::uint32_t cell_z,
                     const Light& light) {
  const auto [centre_x, centre_z] = cell_centre(shape, cell_x, cell_z);
  const float dx = light.position.x - centre_x, dz = light.position.z - centre_z;
  return light.flux_lm / (dx * dx + dz * dz + shape.softening_m2);
}

LightGrid build_light_grid(std::span<const Light> lights, LightLists lists) {
  std::vector<float> flux_lm;
  flux_lm.reserve(lights.size());
  for (const Light& light : lights) flux_lm.push_back(light.flux_lm);
  return build_light_grid(lights, flux_lm, lists);
}

LightGrid build_light_grid(std::span<const Light> lights, std::span<const float> flux_lm,
                           LightLists lists) {
  LightGrid grid;
  float lower_x = INFINITY, lower_z = INFINITY, upper_x = -INFINITY, upper_z = -INFINITY;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Light& light = lights[i];
    if (!(flux_lm[i] > 0)) continue;
    lower_x = std::min(lower_x, light.position.x);
    upper_x = std::max(upper_x, light.position.x);
    lower_z = std::min(lower_z, light.position.z);
    upper_z = std::max(upper_z, light.position.z);
  }
  if (!(lower_x <= upper_x)) return grid;  // no light shines: width 0 tells the shader

  gpu::LightGridShape& shape = grid.shape;
  const float extent_x = upper_x - lower_x, extent_z = upper_z - lower_z;
  const float max_cells = max_entries / float(lists.listed);
  shape.cell_m = std::max({lists.min_cell_m, std::sqrt(extent_x / max_cells * extent_z),
                           extent_x / 4096, extent_z / 4096});
  shape.origin_x = lower_x;
  shape.origin_z = lower_z;
  shape.width = static_cast<std::uint32_t>(extent_x / shape.cell_m) + 1;
  shape.depth = static_cast<std::uint32_t>(extent_z / shape.cell_m) + 1;
  shape.softening_m2 =
      shape.cell_m * shape.cell_m / 4;  // a lamp right above the cell's centre stays finite

  const std::vector<Bins> classes = by_class(lights, flux_lm, shape);
  std::vector<Row> rows(shape.depth);
  run_parallel(shape.depth, count_cores(), [&](std::size_t z) {
    for (std::uint32_t x = 0; x < shape.width; ++x)
      add_cell(rows[z], strongest(classes, shape, lists.listed, x, std::uint32_t(z)), lists.listed);
  });
  std::size_t cells = 0, entries = 0;
  for (const Row& row : rows) {
    cells += row.cells.size();
    entries += row.entries.size();
  }
  grid.cells.reserve(cells);
  grid.entries.reserve(entries);
  for (Row& row : rows) {
    const auto before = static_cast<std::uint32_t>(grid.entries.size());
    for (gpu::LightCell& cell : row.cells) cell.first += before;
    grid.cells.insert(grid.cells.end(), row.cells.begin(), row.cells.end());
    grid.entries.insert(grid.entries.end(), row.entries.begin(), row.entries.end());
    row = {};
  }
  return grid;
}

}  // namespace nightcity::scene
