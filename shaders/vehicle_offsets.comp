#version 460
#extension GL_GOOGLE_include_directive : require
// Vehicles, step 2 of 5, one work group: turns each cell's number of vehicles into its first place
// in the order (a prefix sum).
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"
#include "shaders/vehicle_cells.glsl"

shared uint sums[WORKGROUP_ROW];

void main() {
  const uint lane = gl_LocalInvocationID.x;
  const uint cells = vehicle_cells() + 1u;
  const uint stretch = (cells + WORKGROUP_ROW - 1u) / WORKGROUP_ROW;
  const uint first = lane * stretch, end = min(first + stretch, cells);
  uint sum = 0u;
  for (uint cell = first; cell < end; ++cell) sum += FRAME.vehicle_counts.at[cell];
  sums[lane] = sum;
  barrier();
  uint place = 0u;
  for (uint i = 0u; i < lane; ++i) place += sums[i];
  for (uint cell = first; cell < end; ++cell) {
    const uint count = FRAME.vehicle_counts.at[cell];
    FRAME.vehicle_counts.at[cell] = place;
    place += count;
  }
}
