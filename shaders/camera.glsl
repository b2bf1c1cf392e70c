// Rays from the camera.

// Returns the unit direction through a pixel, at this frame's sub-pixel offset.
vec3 camera_direction(uvec2 pixel) {
  const Camera camera = FRAME.camera;
  const vec2 screen =
      (vec2(pixel) + vec2(FRAME.jitter_x, FRAME.jitter_y)) / vec2(FRAME.size) * 2.0 - 1.0;
  return normalize(camera.forward +
                   camera.right * (screen.x * camera.tan_half_height * camera.aspect) -
                   camera.up * (screen.y * camera.tan_half_height));
}
