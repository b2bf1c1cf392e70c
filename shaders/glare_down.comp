#version 460
#extension GL_GOOGLE_include_directive : require
// Makes level push.first of the glare's pyramid from the level below, with the filter
// (1 4 6 4 1) / 16 in each direction (Burt, Adelson: The Laplacian pyramid as a compact image code,
// 1983).
#include "shaders/common.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/glare.glsl"

void main() {
  const uvec2 pixel = INVOCATION.xy, size = FRAME.glare.size[push.first];
  if (any(greaterThanEqual(pixel, size))) return;
  const float weight[5] = float[](1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);
  vec3 sum = vec3(0.0);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x)
      sum += weight[x] * weight[y] *
             level_at(push.first - 1u, 2 * ivec2(pixel) + ivec2(x - 2, y - 2));
  FRAME.glare.levels.at[FRAME.glare.first[push.first] + pixel.y * size.x + pixel.x] = sum;
}
