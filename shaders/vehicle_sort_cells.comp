#version 460
#extension GL_GOOGLE_include_directive : require
// Fleet, step 4 of 5, an invocation a cell: those of one cell by trip. Step 1 numbered them in the order in which the device
// came to them, and a picture must not depend on that.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"

void main() {
  const uint cell = gl_GlobalInvocationID.x;
  if (cell >= VEHICLE_CELLS) return;
  const uint first = FRAME.vehicle_counts.at[cell], end = FRAME.vehicle_counts.at[cell + 1u];
  if (end - first > 128u) return;  // sorted by insertion: a crowd on one spot costs its square
  for (uint i = first + 1u; i < end; ++i) {
    const VehicleNode node = FRAME.vehicle_nodes.at[i];
    uint to = i;
    while (to > first && FRAME.vehicle_nodes.at[to - 1u].trip > node.trip) {
      FRAME.vehicle_nodes.at[to] = FRAME.vehicle_nodes.at[to - 1u];
      --to;
    }
    FRAME.vehicle_nodes.at[to] = node;
  }
}
