// Rays from the camera.
#include "shaders/projection.glsl"

// Returns the unit direction through a pixel, at this frame's sub-pixel offset.
vec3 camera_direction(uvec2 pixel) {
  const Camera camera = FRAME.camera;
  const vec2 screen =
      (vec2(pixel) + vec2(FRAME.jitter_x, FRAME.jitter_y)) / vec2(FRAME.size) * 2.0 - 1.0;
  return direction_of(camera, screen);
}

// Returns the angle between neighbouring pixels in the middle of the picture, radians.
float pixel_spread() {
  const uvec2 size = FRAME.size;
  if (PROJECTION == PROJECTION_PERSPECTIVE)
    return 2.0 * FRAME.camera.tan_half_height / float(size.y);
  return PI / float(PROJECTION == PROJECTION_FISHEYE ? min(size.x, size.y) : size.y);
}
