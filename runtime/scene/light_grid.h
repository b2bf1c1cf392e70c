// A map grid whose cells list the lights that are strongest there, to sample candidates from. A
// street lamp lights its own street, and sampling among 10^5 lamps by flux alone almost never finds
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "formats/large_vector.h"
#include "shaders/interface.h"

namespace nightcity::scene {

struct LightGrid {
  gpu::LightGridShape shape{};
  std::vector<gpu::LightCell> cells;    // row by row along Z, then X
  LargeVector<gpu::GridEntry> entries;  // one alias table per cell
};

/// The size of a grid's cells and the length of their lists.
struct LightLists {
  float min_cell_m;
  std::uint32_t listed;  // lights per cell, at most
  // All lists together have at most `entries` entries or, where it is more, this many a light. Of
  // lights that lie evenly, no more than listed / entries_a_light are then in a cell, so that its
  // list reaches far beyond the lights above its corners.
  std::uint32_t entries_a_light = 8, entries = 1 << 24;
};

/// The near grid: the lights that give a place most of its light.
constexpr LightLists near_lists{16, 256, 16};
/// The far grid: lights that matter only together, such as thousands of windows in the
/// neighbourhood. Without it, a light for which the near grid has no room is sampled so seldom that
/// its light shows as single bright pixels.
constexpr LightLists far_lists{128, 4096};

/// Builds a grid over all lights that have flux. The strength of a light in a cell is flux /
/// (squared horizontal distance from the cell's centre + shape.softening_m2), and candidates are
/// sampled in proportion to it. A cell lists its strongest lights. It lists fewer where the next
/// weaker one is so close in strength that float rounding could confuse the two, because a shader
/// decides membership by a threshold. Cells are larger than `lists` asks for where the lists could
/// have more entries (12 bytes each) than it allows.
LightGrid build_light_grid(std::span<const Light> lights, LightLists lists);

/// The same for lights whose fluxes at present are `flux_lm`, parallel to `lights`.
LightGrid build_light_grid(std::span<const Light> lights, std::span<const float> flux_lm,
                           LightLists lists);

/// Gives memory for so many entries at most, of which the first will be used.
using TakeEntryMemory = std::function<std::span<gpu::GridEntry>(std::size_t most)>;

/// Fills the shape and the cells of a grid as build_light_grid does, and puts the entries into the
/// memory that `take` gives. Returns how many there are; `take` is not called if no light shines.
std::size_t fill_light_grid(std::span<const Light> lights, std::span<const float> flux_lm,
                            LightLists lists, const TakeEntryMemory& take, LightGrid& grid);

/// Returns a light's strength in a cell, as the shader computes it.
float light_strength(const gpu::LightGridShape& shape, std::uint32_t cell_x, std::uint32_t cell_z,
                     const Light& light);

}  // namespace nightcity::scene
