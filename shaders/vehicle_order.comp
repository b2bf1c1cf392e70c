#version 460
#extension GL_GOOGLE_include_directive : require
// Vehicles, step 3 of 5, one invocation per trip: copies the trip's box to its place in the order.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"

void main() {
  const uint trip = gl_GlobalInvocationID.x;
  if (trip >= SCENE.traffic.trip_count) return;
  const uint cell = FRAME.vehicle_cells.at[2u * trip];
  const uint place = FRAME.vehicle_counts.at[cell] + FRAME.vehicle_cells.at[2u * trip + 1u];
  FRAME.vehicle_nodes.at[place] = FRAME.vehicle_boxes.at[trip];
}
