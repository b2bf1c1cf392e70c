#include "runtime/scene/light_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "formats/parallel.h"
#include "runtime/scene/alias_table.h"
#include "runtime/scene/bounds.h"

namespace nightcity::scene {
namespace {

constexpr float max_entries = 16777216.0f;  // in the lists of all cells
// Cells cover places up to here, m: squares of distances stay finite. Lights beyond it are listed
// in the cells at the rim, by their true distance.
constexpr float max_coordinate_m = 1e7f;
// A shader, whose rounding differs from ours, may confuse strengths whose ratio is below this.
constexpr float min_gap = 1.0001f;

// The radius of the search for lights around a cell, in bins of their class.
constexpr float max_reach_bins = 24;

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
  float max_reach_m() const { return max_reach_bins * side_m_; }

  // Returns an upper bound of a light's strength at this distance from the centre of a cell.
  float max_strength(float distance_m) const {
    return max_flux_ / (distance_m * distance_m + shape_.softening_m2);
  }

  // Returns a distance from the centre of a cell beyond which no light is stronger than `bar`
  // there. It is negative where no light is.
  float find_reach(float bar) const {
    constexpr float rounding = 1.001f;
    const float squared = rounding * max_flux_ / bar - shape_.softening_m2;
    return squared < 0 ? -1.0f : rounding * std::sqrt(squared);
  }

  // Calls `use` with ranges of lights, among which are all within `reach_m` of (x, z).
  template <class Use>
  void for_each_near(float x, float z, float reach_m, Use use) const {
    const int end = row(z + reach_m);
    for (int bz = row(z - reach_m); bz <= end; ++bz) {
      // The rows' lights are at least this far along Z. The place of a light in a bin was rounded.
      const float lower = shape_.origin_z + float(bz) * side_m_,
                  away = std::max({lower - z, z - (lower + side_m_), 0.0f}) - 1e-3f * side_m_;
      const float half = std::sqrt(std::max(0.0f, reach_m * reach_m - away * std::abs(away)));
      const std::size_t first = std::size_t(bz) * std::size_t(width_),
                        from = starts_[first + std::size_t(column(x - half))],
                        to = starts_[first + std::size_t(column(x + half)) + 1];
      if (from < to) use(LightRange{&x_[from], &z_[from], &flux_[from], &order_[from], to - from});
    }
  }

 private:
  int place(float along, int count) const {
    return int(std::clamp(along / side_m_, 0.0f, float(count - 1)));
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

// A light and its strength, as one number that compares by strength: the bits of floats that are
// not negative have their order.
using Found = std::uint64_t;
Found make_found(float strength, std::uint32_t light) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(strength)} << 32 | (UINT32_MAX - light);
}
float strength_of(Found found) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(found >> 32));
}
std::uint32_t light_of(Found found) {
  return UINT32_MAX - static_cast<std::uint32_t>(found);
}

// Finds the strongest lights of cells that lie in a row, and keeps its memory from cell to cell.
class Search {
 public:
  Search(const std::vector<Bins>& classes, const gpu::LightGridShape& shape, std::size_t listed)
      : classes_(classes), shape_(shape), listed_(listed) {
    for (const Bins& bins : classes) bar_ = std::max(bar_, bins.max_strength(0));
  }

  // Finds the lights that a cell lists, in no order.
  std::span<const Found> find(std::uint32_t x, std::uint32_t z) {
    const auto [centre_x, centre_z] = cell_centre(shape_, x, z);
    while (!find_stronger(centre_x, centre_z) && count_ <= listed_)
      // As many lights more are found as the area grows, where they stand evenly.
      bar_ *= std::clamp(0.9f * float(count_) / float(listed_ + 1), 0.05f, 0.8f);
    // Also within the radius of the search, lights below the bar are not listed: there is no end to
    // how much fainter than the strongest of its class a light may be.
    outside_ = std::max(unseen_, bar_);
    if (count_ > listed_) {
      const auto last = found_.begin() + std::ptrdiff_t(listed_);
      std::nth_element(found_.begin(), last, found_.begin() + std::ptrdiff_t(count_),
                       std::greater<Found>());
      count_ = listed_;
      outside_ = std::max(outside_, strength_of(*last));
      bar_ = 0.8f * strength_of(*last);  // the cell beside this one is much like it
    }
    leave_gap();
    return {found_.data(), count_};
  }

  // Returns the strength of the strongest light that the last cell does not list, or more.
  float outside() const { return outside_; }

 private:
  // Finds all lights that are stronger than the bar in the cell with this centre, or those of them
  // that are within the radius of the search. Returns whether a lower bar would find no more.
  bool find_stronger(float x, float z) {
    count_ = 0;
    unseen_ = 0;
    bool all = true;
    const float width_m = float(shape_.width) * shape_.cell_m,
                depth_m = float(shape_.depth) * shape_.cell_m,
                farthest = std::hypot(width_m, depth_m);
    for (const Bins& bins : classes_) {
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
  void add_stronger(const LightRange& range, float centre_x, float centre_z) {
    if (found_.size() < count_ + range.count + 1) found_.resize(2 * (count_ + range.count + 1));
    const auto load = [](const float* from) {
      Float4 four;
      std::memcpy(&four, from, sizeof four);
      return four;
    };
    // Every light is written, and the next one over it if it is too weak: no branch to mispredict.
    Found* to = found_.data() + count_;
    std::size_t i = 0;
    for (; i + 4 <= range.count; i += 4) {
      const Float4 dx = load(range.x + i) - centre_x, dz = load(range.z + i) - centre_z,
                   value = load(range.flux + i) / (dx * dx + dz * dz + shape_.softening_m2);
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
  void leave_gap() {
    while (true) {
      const float limit = outside_ * min_gap;
      std::size_t kept = 0;
      for (std::size_t i = 0; i < count_; ++i) {
        const float strength = strength_of(found_[i]);
        if (strength > limit)
          found_[kept++] = found_[i];
        else
          outside_ = std::max(outside_, strength);
      }
      if (kept == count_) return;
      count_ = kept;
    }
  }

  const std::vector<Bins>& classes_;
  const gpu::LightGridShape& shape_;
  std::size_t listed_;
  std::vector<Found> found_;  // the first count_ of these, and room for more
  std::size_t count_ = 0;
  float bar_ = 0, unseen_ = 0, outside_ = 0;
};

// Fills the lists of a row of cells. Their entries, from which the cells count, are appended to
// `entries`, which is empty.
void fill_row(const std::vector<Bins>& classes, const gpu::LightGridShape& shape,
              std::size_t listed, std::uint32_t z, std::span<gpu::LightCell> cells,
              std::vector<gpu::GridEntry>& entries) {
  Search search(classes, shape, listed);
  AliasTableBuilder table;
  std::vector<float> weights;
  for (std::uint32_t x = 0; x < shape.width; ++x) {
    const std::span<const Found> found = search.find(x, z);
    gpu::LightCell& cell = cells[x];
    cell.first = static_cast<std::uint32_t>(entries.size());
    cell.count = static_cast<std::uint32_t>(found.size());
    weights.clear();
    double sum = 0;
    for (const Found f : found) {
      weights.push_back(strength_of(f));
      sum += double(weights.back());
    }
    cell.strength_sum = static_cast<float>(sum);
    // The threshold lies between the weakest light inside and the strongest outside.
    cell.threshold = found.empty() ? 0.0f
                                   : std::sqrt(*std::min_element(weights.begin(), weights.end())) *
                                         std::sqrt(search.outside());
    const std::span<const gpu::AliasEntry> alias = table.build(weights);
    for (std::size_t i = 0; i < found.size(); ++i)
      entries.push_back({light_of(found[i]), alias[i].keep, light_of(found[alias[i].alias])});
  }
}

}  // namespace

float light_strength(const gpu::LightGridShape& shape, std::uint32_t cell_x, std::uint32_t cell_z,
                     const Light& light) {
  const auto [centre_x, centre_z] = cell_centre(shape, cell_x, cell_z);
  const float dx = light.position.x - centre_x, dz = light.position.z - centre_z;
  return light.flux_lm / (dx * dx + dz * dz + shape.softening_m2);
}

namespace {

std::span<gpu::LightCell> row_of(LightGrid& grid, std::size_t z) {
  return std::span(grid.cells).subspan(z * grid.shape.width, grid.shape.width);
}

// Appends the entries of rows to a grid in the rows' order, whichever is filled first. Only rows
// that wait for one before theirs are in memory twice, and their memory is used again.
class RowAppender {
 public:
  using Entries = std::vector<gpu::GridEntry>;
  explicit RowAppender(LightGrid& grid) : grid_(grid), rows_(grid.shape.depth) {}

  // Calls `fill` with an empty vector for the entries of row `z`.
  template <class Fill>
  void append(std::size_t z, Fill fill) {
    Entries entries = take_empty();
    fill(entries);
    const std::lock_guard lock(appending_);
    rows_[z] = std::move(entries);
    for (; next_ < rows_.size() && rows_[next_]; ++next_) {
      const auto end = static_cast<std::uint32_t>(grid_.entries.size());
      for (gpu::LightCell& cell : row_of(grid_, next_)) cell.first += end;
      Entries row = std::move(*rows_[next_]);
      rows_[next_].reset();
      grid_.entries.insert(grid_.entries.end(), row.begin(), row.end());
      row.clear();
      empty_.push_back(std::move(row));
    }
  }

 private:
  Entries take_empty() {
    const std::lock_guard lock(appending_);
    if (empty_.empty()) return {};
    Entries entries = std::move(empty_.back());
    empty_.pop_back();
    return entries;
  }

  LightGrid& grid_;
  std::mutex appending_;
  std::vector<std::optional<Entries>> rows_;
  std::vector<Entries> empty_;
  std::size_t next_ = 0;
};

}  // namespace

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
    const float x = std::clamp(light.position.x, -max_coordinate_m, max_coordinate_m),
                z = std::clamp(light.position.z, -max_coordinate_m, max_coordinate_m);
    lower_x = std::min(lower_x, x);
    upper_x = std::max(upper_x, x);
    lower_z = std::min(lower_z, z);
    upper_z = std::max(upper_z, z);
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
  std::size_t shining = 0;
  for (const float f : flux_lm) shining += f > 0;
  grid.cells.resize(std::size_t{shape.width} * shape.depth);
  // Room for full lists. Memory that is not written to takes no room.
  grid.entries.reserve(grid.cells.size() * std::min<std::size_t>(lists.listed, shining));
  RowAppender rows(grid);
  run_parallel(shape.depth, count_cores(), [&](std::size_t z) {
    rows.append(z, [&](std::vector<gpu::GridEntry>& entries) {
      fill_row(classes, shape, lists.listed, std::uint32_t(z), row_of(grid, z), entries);
    });
  });
  return grid;
}

}  // namespace nightcity::scene
