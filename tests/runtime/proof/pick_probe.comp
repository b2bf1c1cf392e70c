#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// Counts how many of the 2^32 random words pick each of some whole numbers below n.
layout(local_size_x = 1) in;
layout(buffer_reference, scalar) writeonly buffer Counts { uint at[]; };
layout(push_constant, scalar) uniform Push {
  Counts counts;
  uint n;
  uint step;
} push;

struct FrameNumbers {
  uint frame, seed;
};
const FrameNumbers FRAME = FrameNumbers(0u, 0u);
#include "shaders/random.glsl"

// Returns the first word that picks `number` or more: picks ascend with the words.
uint first_word(uint number) {
  uint first = 0u;
  for (uint bit = 1u << 31u; bit != 0u; bit >>= 1u)
    if (scale_word(first + bit - 1u, push.n) < number) first += bit;
  return first;
}

void main() {
  const uint number = gl_GlobalInvocationID.x * push.step;
  // For the last number the end, 2^32, wraps to 0, which is what the difference needs.
  const uint end = number + 1u < push.n ? first_word(number + 1u) : 0u;
  push.counts.at[gl_GlobalInvocationID.x] = end - first_word(number);
}
