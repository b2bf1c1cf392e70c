// The reference's light: every light, with one stratified sample each, and more on a light close
// by.

// Returns whether a light fills much of a hemisphere; the surface may hide half of it, as the top
// of a lamp's own post does.
bool is_close(Light light, vec3 position) {
  const vec3 way = light.position - position;
  return dot(way, way) < CLOSE_RADII * CLOSE_RADII * bounding_radius2(light);
}

// Returns point i of a light's points in this frame. On a surface that stays from frame to frame
// they are stratified over frames, from a start of its own for each pixel and light.
vec2 point_of_light(uvec2 pixel, uint light, uint i, uint points, bool stays) {
  if (!stays) return vec2(random_float(), random_float());
  const uvec4 start = pcg4d(uvec4(pixel, light, FRAME.seed * 16u + STREAM_REFERENCE));
  return r2_point(start.xy, FRAME.frame * points + i);
}

// Returns the light that a receiver reflects from the lights from `first` to before `end`, each
// weighted by share_of_path(). `stays`: it is the surface seen in the pixel, and not one that a
// path meets.
vec3 reflected_from_all(uvec2 pixel, Receiver receiver, uint first, uint end, bool stays,
                        inout LightLayers layers) {
  vec3 sum = vec3(0.0);
  uint close_left = MAX_CLOSE_LIGHTS;
  for (uint index_of_light = first; index_of_light < end; ++index_of_light) {
    const Light light = light_at(index_of_light);
    uint points = 1u;
    if (close_left > 0u && is_close(light, receiver.position)) {
      points = CLOSE_POINTS;
      --close_left;
    }
    for (uint i = 0u; i < points; ++i) {
      const vec2 uv = point_of_light(pixel, index_of_light, i, points, stays);
      const LightSample s = sample_point(light, uv, receiver.position);
      const vec3 f = reflected(receiver, s) * (share_of_path(receiver, s.point) / float(points));
      if (luminance(f) > 0.0 && !occluded(receiver.origin, s.point, false)) {
        add_direct(layers, index_of_light, light, f);
        sum += f;
      }
    }
  }
  return sum;
}
