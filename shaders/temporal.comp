#version 460
#extension GL_GOOGLE_include_directive : require
// Temporal reuse: the pixel's own reservoir with the one its surface had in the frame before.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/reuse.glsl"

// Where `position` was on the previous frame's screen; false when behind the eye or outside.
bool previous_pixel(vec3 position, out uvec2 pixel) {
  const Camera camera = FRAME.previous_camera;
  const vec3 d = position - camera.position;
  const float z = dot(d, camera.forward);
  pixel = uvec2(0u);
  if (z <= 0.0) return false;
  const vec2 screen = vec2(dot(d, camera.right) / camera.aspect, -dot(d, camera.up)) / (z * camera.tan_half_height);
  const vec2 p = (screen * 0.5 + 0.5) * vec2(FRAME.size);
  if (any(lessThan(p, vec2(0.0))) || any(greaterThanEqual(p, vec2(FRAME.size)))) return false;
  pixel = uvec2(p);
  return true;
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  uvec2 before;
  const vec3 was_at = surface.position + surface.motion;
  if (FRAME.has_history == 0u || surface.depth <= 0.0 || !previous_pixel(was_at, before)) return;
  const uint before_index = before.y * FRAME.size.x + before.x;
  const Surface previous_surface = FRAME.previous_surfaces.at[before_index];
  // As the eye saw it then, so that neither its own motion nor the camera's makes it look like another surface.
  Surface expected = surface;
  expected.position = was_at;
  expected.depth = distance(was_at, FRAME.previous_camera.position);
  if (!similar(expected, previous_surface)) return;

  Reservoir history = guarded(FRAME.previous_reservoirs.at[before_index]);
  const Reservoir canonical = FRAME.reservoirs.at[index];
  // Old samples fade: without a cap the history would outvote every new candidate.
  history.M = min(history.M, FRAME.history_cap * canonical.M);
  if (history.M <= 0.0) return;

  seed_random(pixel, STREAM_TEMPORAL);
  const Receiver receiver = receiver_of(surface);
  Receiver there = receiver_of(previous_surface);
  there.before = true;
  Reuse reuse = begin_reuse(receiver, canonical, history.M);
  add_other(reuse, receiver, canonical, history, there, 1u);
  add_canonical(reuse, canonical);

  float normalisation = 1.0;
  if (ESTIMATOR == ESTIMATOR_PAPER) {
    normalisation = 1.0 / reuse.selection.M;
  } else if (ESTIMATOR == ESTIMATOR_BASIC) {
    const Selection s = reuse.selection;
    const float p_there = target(there, s.light, s.uv);
    const float p_source = reuse.chosen == 0u ? s.target : p_there;
    const float sum = canonical.M * s.target + history.M * p_there;
    normalisation = sum > 0.0 ? p_source / sum : 0.0;
  }
  FRAME.reservoirs.at[index] = finished(reuse.selection, normalisation);
}
