// Lines along the edges of triangles, as wide as a pixel however far away they are.

vec3 turn_to_object(Instance instance, vec3 direction) {
  return vec3(dot(instance.to_object[0].xyz, direction),
              dot(instance.to_object[1].xyz, direction),
              dot(instance.to_object[2].xyz, direction));
}

vec3 move_to_object(Instance instance, vec3 point) {
  return turn_to_object(instance, point) +
         vec3(instance.to_object[0].w, instance.to_object[1].w, instance.to_object[2].w);
}

// A ray through a pixel's centre, not of unit length, and its change from a pixel to the next: both
// are linear in the picture of a perspective camera.
struct PixelRay {
  vec3 direction, to_right, down;
};

PixelRay ray_of_pixel(uvec2 pixel) {
  const Camera camera = FRAME.camera;
  const vec2 size = vec2(FRAME.size);
  const vec2 at = (vec2(pixel) + 0.5) / size * 2.0 - 1.0;
  const vec3 right = camera.right * (camera.tan_half_height * camera.aspect),
             down = -camera.up * camera.tan_half_height;
  return PixelRay(camera.forward + right * at.x + down * at.y, right * (2.0 / size.x),
                  down * (2.0 / size.y));
}

// Returns the distance of a pixel's centre from the outline of a triangle on the screen, in pixels;
// negative outside. An edge and the camera span a plane; how far a ray lies from it is linear in
// the picture, so edges that pass behind the camera need no clipping.
float distance_inside(PixelRay ray, uint triangle, Instance instance) {
  const vec3 eye = move_to_object(instance, FRAME.camera.position);
  const vec3 direction = turn_to_object(instance, ray.direction),
             to_right = turn_to_object(instance, ray.to_right),
             down = turn_to_object(instance, ray.down);
  vec3 corners[3];
  for (uint i = 0u; i < 3u; ++i)
    corners[i] = SCENE.triangles.at[triangle * 3u + i].xyz - eye;
  const float side = sign(dot(cross(corners[0], corners[1] - corners[0]), corners[2]));
  float nearest = 1e9;
  for (uint i = 0u; i < 3u; ++i) {
    const vec3 plane = cross(corners[i], corners[(i + 1u) % 3u] - corners[i]) * side;
    const float slope = length(vec2(dot(plane, to_right), dot(plane, down)));
    if (slope > 0.0) nearest = min(nearest, dot(plane, direction) / slope);
  }
  return nearest;
}

// Returns how far a line along the edges covers a pixel, 0 .. 1. Triangles of the pixels around it
// count, so that outlines against the sky are as wide as other lines.
float wire_at(uvec2 pixel) {
  const PixelRay ray = ray_of_pixel(pixel);
  const uint own = pixel.y * FRAME.size.x + pixel.x;
  const uvec2 own_hit = uvec2(FRAME.hits.at[2u * own], FRAME.hits.at[2u * own + 1u]);
  float cover = 0.0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const ivec2 at = ivec2(pixel) + ivec2(dx, dy);
      if (!in_picture(at)) continue;
      const uint index = uint(at.y) * FRAME.size.x + uint(at.x);
      const uvec2 hit = uvec2(FRAME.hits.at[2u * index], FRAME.hits.at[2u * index + 1u]);
      // Most neighbours show the pixel's own triangle, which is looked at once.
      if (hit.y == NO_HIT || (hit == own_hit && index != own)) continue;
      const float inside = distance_inside(ray, hit.x, SCENE.instances.at[hit.y]);
      cover = max(cover, 1.0 - abs(inside));
    }
  return cover;
}
