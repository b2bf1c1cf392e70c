// Rays from the camera.
#include "shaders/projection.glsl"

// Returns the unit direction through a pixel, at an offset in [0, 1) within it.
vec3 direction_within(uvec2 pixel, vec2 offset) {
  return direction_of(FRAME.camera, (vec2(pixel) + offset) / vec2(FRAME.size) * 2.0 - 1.0);
}

// Returns the unit direction through a pixel, at this frame's sub-pixel offset.
vec3 camera_direction(uvec2 pixel) {
  return direction_within(pixel, vec2(FRAME.jitter_x, FRAME.jitter_y));
}

// Returns the angle between neighbouring pixels in the middle of the picture, radians.
float pixel_spread() {
  const uvec2 size = FRAME.size;
  if (PROJECTION == PROJECTION_PERSPECTIVE)
    return 2.0 * FRAME.camera.tan_half_height / float(size.y);
  return PI / float(PROJECTION == PROJECTION_FISHEYE ? min(size.x, size.y) : size.y);
}
