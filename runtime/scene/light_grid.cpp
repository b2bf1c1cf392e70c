#include "runtime/scene/light_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

#include "formats/parallel.h"
#include "formats/touch_pages.h"
#include "runtime/scene/alias_table.h"
#include "runtime/scene/light_bins.h"
#include "runtime/scene/strongest_lights.h"

namespace nightcity::scene {
namespace {

// Cells cover places up to here, m: squares of distances stay finite. Lights beyond it are listed
// in the cells at the rim, by their true distance.
constexpr float max_coordinate_m = 1e7f;
// Fills the lists of a row of cells. Their entries, from which the cells count, are appended to
// `entries`, which is empty.
void fill_row(const std::vector<LightBins>& classes, const gpu::LightGridShape& shape,
              std::size_t listed, std::uint32_t z, std::span<gpu::LightCell> cells,
              LargeVector<gpu::GridEntry>& entries) {
  StrongestLights search(classes, shape, listed);
  AliasTableBuilder table;
  std::vector<float> weights;
  for (std::uint32_t x = 0; x < shape.width; ++x) {
    const std::span<const FoundLight> found = search.find(x, z);
    gpu::LightCell& cell = cells[x];
    cell.first = static_cast<std::uint32_t>(entries.size());
    cell.count = static_cast<std::uint32_t>(found.size());
    weights.resize(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) weights[i] = strength_of(found[i]);
    const std::span<const gpu::AliasEntry> alias = table.build(weights);
    cell.strength_sum = static_cast<float>(table.sum());
    // The threshold lies between the weakest light inside and the strongest outside.
    cell.threshold =
        found.empty() ? 0.0f : std::sqrt(search.weakest()) * std::sqrt(search.outside());
    entries.resize(cell.first + found.size());
    gpu::GridEntry* const to = entries.data() + cell.first;
    for (std::size_t i = 0; i < found.size(); ++i)
      to[i] = {light_of(found[i]), alias[i].keep, light_of(found[alias[i].alias])};
  }
}

std::span<gpu::LightCell> row_of(LightGrid& grid, std::size_t z) {
  return std::span(grid.cells).subspan(z * grid.shape.width, grid.shape.width);
}

// Puts the entries of rows behind each other in the rows' order, whichever is filled first. Only
// rows that wait for one before theirs are in memory twice, and their memory is used again.
class RowAppender {
 public:
  using Entries = LargeVector<gpu::GridEntry>;
  RowAppender(LightGrid& grid, std::span<gpu::GridEntry> to)
      : grid_(grid), to_(to), rows_(grid.shape.depth) {}

  // Calls `fill` with an empty vector for the entries of row `z`.
  template <class Fill>
  void append(std::size_t z, Fill fill) {
    Entries entries = take_empty();
    fill(entries);
    const std::lock_guard lock(appending_);
    rows_[z] = std::move(entries);
    for (; next_ < rows_.size() && rows_[next_]; ++next_) {
      for (gpu::LightCell& cell : row_of(grid_, next_))
        cell.first += static_cast<std::uint32_t>(count_);
      Entries row = std::move(*rows_[next_]);
      rows_[next_].reset();
      const std::span<gpu::GridEntry> place = to_.subspan(count_, row.size());
      touch_pages(place);
      std::copy(row.begin(), row.end(), place.begin());
      count_ += row.size();
      row.clear();
      empty_.push_back(std::move(row));
    }
  }

  std::size_t count() const { return count_; }

 private:
  Entries take_empty() {
    const std::lock_guard lock(appending_);
    if (empty_.empty()) return {};
    Entries entries = std::move(empty_.back());
    empty_.pop_back();
    return entries;
  }

  LightGrid& grid_;
  std::span<gpu::GridEntry> to_;
  std::size_t count_ = 0;  // entries so far
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
  const auto take = [&](std::size_t most) {
    grid.entries.resize(most);  // what is not written to takes no room
    return std::span(grid.entries);
  };
  grid.entries.resize(fill_light_grid(lights, flux_lm, lists, take, grid));
  return grid;
}

std::size_t fill_light_grid(std::span<const Light> lights, std::span<const float> flux_lm,
                            LightLists lists, const TakeEntryMemory& take, LightGrid& grid) {
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
  if (!(lower_x <= upper_x)) return 0;  // no light shines: width 0 tells the shader

  gpu::LightGridShape& shape = grid.shape;
  const float extent_x = upper_x - lower_x, extent_z = upper_z - lower_z;
  const auto shining = static_cast<std::size_t>(
      std::count_if(flux_lm.begin(), flux_lm.end(), [](float flux) { return flux > 0; }));
  const double entries =
      std::max(double(lists.entries), double(lists.entries_a_light) * double(shining));
  const auto max_cells = static_cast<float>(entries / lists.listed);
  shape.cell_m = std::max({lists.min_cell_m, std::sqrt(extent_x / max_cells * extent_z),
                           extent_x / 4096, extent_z / 4096});
  shape.origin_x = lower_x;
  shape.origin_z = lower_z;
  shape.width = static_cast<std::uint32_t>(extent_x / shape.cell_m) + 1;
  shape.depth = static_cast<std::uint32_t>(extent_z / shape.cell_m) + 1;
  shape.softening_m2 =
      shape.cell_m * shape.cell_m / 4;  // a lamp right above the cell's centre stays finite

  const std::vector<LightBins> classes = sort_into_bins(lights, flux_lm, shape);
  grid.cells.resize(std::size_t{shape.width} * shape.depth);
  RowAppender rows(grid, take(grid.cells.size() * std::min<std::size_t>(lists.listed, shining)));
  run_parallel(shape.depth, count_cores(), [&](std::size_t z) {
    rows.append(z, [&](RowAppender::Entries& entries) {
      fill_row(classes, shape, lists.listed, std::uint32_t(z), row_of(grid, z), entries);
    });
  });
  return rows.count();
}

float light_strength(const gpu::LightGridShape& shape, std::uint32_t cell_x, std::uint32_t cell_z,
                     const Light& light) {
  const auto [centre_x, centre_z] = find_cell_centre(shape, cell_x, cell_z);
  const float dx = light.position.x - centre_x, dz = light.position.z - centre_z;
  return light.flux_lm / (dx * dx + dz * dz + shape.softening_m2);
}

}  // namespace nightcity::scene
