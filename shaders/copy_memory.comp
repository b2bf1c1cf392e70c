#version 460
#extension GL_GOOGLE_include_directive : require
// Copies memory in words of 16 bytes, each read and written once: how fast the device moves it.
// Each invocation copies COPIED_WORDS, so that one dispatch reaches beyond the caches.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer CopiedWords { uvec4 at[]; };

void main() {
  if (INVOCATION.x >= push.count) return;
  CopiedWords from = CopiedWords(FRAME.previous_accumulation), to = CopiedWords(FRAME.accumulation);
  for (uint i = 0u; i < COPIED_WORDS; ++i) {
    const uint at = i * push.count + INVOCATION.x;
    to.at[at] = from.at[at];
  }
}
