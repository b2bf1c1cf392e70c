#version 460
#extension GL_GOOGLE_include_directive : require
// The irradiance cache, first step: frees the cells that no frame has seen for long, from
// push.first to before push.first + push.count, and readies the others for this frame.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"

const uint CELL_LIFE = 64u;  // frames

void main() {
  if (INVOCATION.x >= push.count) return;
  const uint index = push.first + INVOCATION.x;
  if (index == 0u) FRAME.seen_cells.at[0] = FRAME.uncached.at[0] = 0u;
  const IrradianceCell cell = FRAME.cells.at[index];
  if (cell.key == 0u) return;
  FRAME.cells.at[index].owner = 0u;
  if (FRAME.frame + 1u - cell.seen > CELL_LIFE) FRAME.cells.at[index].key = 0u;
}
