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
  std::vector<gpu::LightCell> cells;     // row by row along Z, then X
  std::vector<gpu::LocalEntry> entries;  // an alias table a cell
};

/// The strength of a light in a cell is flux / (horizontal distance of the cell's centre^2 +
/// shape.softening_m2): the density candidates are drawn with. A cell lists its LOCAL_LIGHTS strongest, fewer
/// where the next weaker one is so close in strength that float could not tell them apart, so that a shader
/// can decide membership by a threshold. Lights without flux are in no cell. Cells are 16 m, more where that
/// would make over 65,536 of them.
LightGrid build_light_grid(std::span<const Light> lights);

/// flux / (d^2 + softening) as the shader computes it.
float local_strength(const gpu::LightGridShape& shape, std::uint32_t cell_x, std::uint32_t cell_z,
                     const Light& light);

}  // namespace nightcity
