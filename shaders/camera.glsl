// Rays from the camera.
#include "shaders/projection.glsl"

// Returns the unit direction through a pixel, at this frame's sub-pixel offset.
vec3 camera_direction(uvec2 pixel) {
  const Camera camera = FRAME.camera;
  const vec2 screen =
      (vec2(pixel) + vec2(FRAME.jitter_x, FRAME.jitter_y)) / vec2(FRAME.size) * 2.0 - 1.0;
  return direction_of(camera, screen);
}
