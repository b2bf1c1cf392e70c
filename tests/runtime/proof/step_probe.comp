#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
// Counts its own loop steps. The bounds come from outside, so that no compiler can count for it.
layout(local_size_x = 1) in;
layout(buffer_reference, scalar) writeonly buffer Result { uint steps; };
layout(push_constant, scalar) uniform Push {
  Result result;
  uint outer;
  uint inner;
} push;

void main() {
  uint steps = 0u;
  for (uint i = 0u; i < push.outer; ++i)
    for (uint j = 0u; j < push.inner; ++j) steps += 1u + (steps >> 31u);
  push.result.steps = steps;
}
