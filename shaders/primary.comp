#version 460
#extension GL_GOOGLE_include_directive : require
// Primary visibility: the surface that the camera sees in each pixel.
#include "shaders/common.glsl"
#include "shaders/geometry.glsl"
#define SKIPS_WHAT_IS_HIDDEN
#include "shaders/trace.glsl"
#include "shaders/surface_hit.glsl"
#include "shaders/camera.glsl"
#include "shaders/trip_pose.glsl"
#include "shaders/blocks.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  if (all(equal(pixel % WORKGROUP_SIZE, uvec2(0u)))) begin_block(block_of(pixel));

  Hit hit;
  Surface surface =
      first_surface(FRAME.camera.position, camera_direction(pixel), MASK_VISIBLE, pixel_spread(),
                    hit);
  if (HAS_TRAFFIC != 0u && surface.depth > 0.0) {
    const Instance instance = SCENE.instances.at[hit.instance];
    if ((instance.mask & MASK_VEHICLE) != 0u) {
      const vec3 local = to_object_space(instance, surface.position);
      const Pose before = trip_pose(hit.instance - SCENE.traffic.first_instance,
                                    FRAME.previous_cycle_time_s, FRAME.previous_time_s);
      if (before.on_road)
        surface.motion = before.position + before.axes * local - surface.position;
    }
  }
  FRAME.surfaces.at[index] = surface;
  if (FRAME.keeps_hits != 0u) {
    // Hits are those of pixels' centres: elsewhere within a pixel, outlines would tremble from
    // frame to frame. The picture keeps its sub-pixels, and so its exposure.
    bool is_hit = surface.depth > 0.0;
    if (vec2(FRAME.jitter_x, FRAME.jitter_y) != vec2(0.5))
      is_hit = first_surface(FRAME.camera.position, direction_within(pixel, vec2(0.5)),
                             MASK_VISIBLE, pixel_spread(), hit).depth > 0.0;
    FRAME.hits.at[2u * index] = hit.triangle;
    FRAME.hits.at[2u * index + 1u] = is_hit ? hit.instance : NO_HIT;
  }
}
