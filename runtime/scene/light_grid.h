// The lights that matter near a place: a map grid whose cells list their strongest lights, for candidates
// that are local. A street lamp lights its own street; picking among 10^5 lamps by flux alone almost never
// finds it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shaders/interface.h"

namespace nightcity {

struct LightGrid {
  gpu::LightGridShape shape{};
  std::vector<gpu::LightCell> cells;    // row by row along Z, then X
  std::vector<gpu::GridEntry> entries;  // an alias table a cell
};

/// How fine a grid is, and how long its lists.
struct LightLists {
  float min_cell_m;
  std::uint32_t listed;  // lights a cell, at most
};

/// The lights a place is mostly lit by.
constexpr LightLists near_lists{16, 256};
/// Lights that matter only together: each of thousands of windows around. Without them, one that the first
/// grid has no room for is picked so seldom that its light comes as single bright pixels.
constexpr LightLists far_lists{128, 4096};

/// The strength of a light in a cell is flux / (horizontal distance of the cell's centre^2 +
/// shape.softening_m2): the density candidates are drawn with. A cell lists its strongest, fewer
/// where the next weaker one is so close in strength that float could not tell them apart, so that a shader
/// can decide membership by a threshold. Lights without flux are in no cell. Cells are larger than asked for
/// where their lists could take more than 200 MB.
LightGrid build_light_grid(std::span<const Light> lights, LightLists lists);

/// flux / (d^2 + softening) as the shader computes it.
float light_strength(const gpu::LightGridShape& shape, std::uint32_t cell_x, std::uint32_t cell_z,
                     const Light& light);

}  // namespace nightcity
