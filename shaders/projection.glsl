// From places in the picture to directions, and back, for each projection of the camera. Frames
// that are compared have the same projection.
#ifndef NIGHTCITY_SHADERS_PROJECTION_GLSL
#define NIGHTCITY_SHADERS_PROJECTION_GLSL

// Returns the unit direction of a place in the picture, -1 .. 1 from left to right and from top to
// bottom.
vec3 direction_of(Camera camera, vec2 screen) {
  switch (PROJECTION) {
    case PROJECTION_EQUIRECTANGULAR: {
      const float longitude = screen.x * PI, latitude = -0.5 * screen.y * PI;
      return cos(latitude) * (sin(longitude) * camera.right + cos(longitude) * camera.forward) +
             sin(latitude) * camera.up;
    }
    case PROJECTION_FISHEYE: {
      // The shorter side has a hemisphere; the angle off the axis grows with the distance from the
      // middle (equidistant).
      const vec2 at = screen * vec2(max(camera.aspect, 1.0), max(1.0 / camera.aspect, 1.0));
      const float radius = length(at), angle = min(0.5 * radius, 1.0) * PI;
      const vec2 side = radius > 0.0 ? at / radius : vec2(0.0);
      return sin(angle) * (side.x * camera.right - side.y * camera.up) +
             cos(angle) * camera.forward;
    }
  }
  return normalize(camera.forward +
                   camera.right * (screen.x * camera.tan_half_height * camera.aspect) -
                   camera.up * (screen.y * camera.tan_half_height));
}

// Finds the place in the picture of a direction of any length; returns false where the picture does
// not have it.
bool screen_of(Camera camera, vec3 d, out vec2 screen) {
  const float x = dot(d, camera.right), y = dot(d, camera.up), z = dot(d, camera.forward);
  screen = vec2(0.0);
  switch (PROJECTION) {
    case PROJECTION_EQUIRECTANGULAR:
      screen = vec2(atan(x, z), -2.0 * atan(y, length(vec2(x, z)))) / PI;
      return true;
    case PROJECTION_FISHEYE: {
      const float across = length(vec2(x, y));
      const float radius = atan(across, z) / (0.5 * PI);
      if (across > 0.0) screen = radius * vec2(x, -y) / across;
      screen /= vec2(max(camera.aspect, 1.0), max(1.0 / camera.aspect, 1.0));
      return true;
    }
  }
  if (z <= 0.0) return false;
  screen = vec2(x / camera.aspect, -y) / (z * camera.tan_half_height);
  return true;
}

#endif
