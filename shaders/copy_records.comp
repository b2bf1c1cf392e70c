#version 460
#extension GL_GOOGLE_include_directive : require
// Copies a list of records, each read and written once: how fast the device moves memory.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"

void main() {
  if (INVOCATION.x >= push.count) return;
  FRAME.accumulation.at[INVOCATION.x] = FRAME.previous_accumulation.at[INVOCATION.x];
}
