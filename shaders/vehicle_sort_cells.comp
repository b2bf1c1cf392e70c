#version 460
#extension GL_GOOGLE_include_directive : require
// Vehicles, step 4 of 5, one invocation per cell: sorts the vehicles of a cell by trip. Step 1
// numbered them in the order in which the device ran, and a picture must not depend on that.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"
#include "shaders/vehicle_cells.glsl"

void main() {
  const uint cell = gl_GlobalInvocationID.x;
  if (cell >= vehicle_cells()) return;
  const uint first = FRAME.vehicle_counts.at[cell], end = FRAME.vehicle_counts.at[cell + 1u];
  if (end - first > 128u) return;  // insertion sort: its cost is the square of a crowd on one spot
  for (uint i = first + 1u; i < end; ++i) {
    const LightNode node = FRAME.vehicle_nodes.at[i];
    uint to = i;
    while (to > first && FRAME.vehicle_nodes.at[to - 1u].item > node.item) {
      FRAME.vehicle_nodes.at[to] = FRAME.vehicle_nodes.at[to - 1u];
      --to;
    }
    FRAME.vehicle_nodes.at[to] = node;
  }
}
