#version 460
#extension GL_GOOGLE_include_directive : require
// Primary visibility: the surface that the camera sees in each pixel.
#include "shaders/common.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/surface_hit.glsl"
#include "shaders/camera.glsl"
#include "shaders/trip_pose.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;

  const Camera camera = FRAME.camera;
  const vec3 direction = camera_direction(pixel);
  Surface surface = Surface(vec3(0.0), 0u, 0.0, 0u, NO_HIT, NO_HIT, vec3(0.0), 0.0);
  Hit hit;
  if (closest_hit(camera.position, direction, hit)) {
    const Instance instance = SCENE.instances.at[hit.instance];
    const SurfaceHit seen = surface_at(hit, instance, camera.position, direction);
    surface.position = seen.position;
    surface.clearance = seen.clearance;
    surface.normal = pack_normal(seen.normal);
    surface.depth = hit.t;
    surface.material = seen.material;
    surface.feature = instance.feature != NO_HIT ? instance.feature : seen.feature;
    if (HAS_TRAFFIC != 0u && (instance.mask & MASK_VEHICLE) != 0u) {
      surface.light = seen.light < VEHICLE_LIGHTS ? instance.light + seen.light : NO_HIT;
      const vec3 local = to_object_space(instance, surface.position);
      const Pose before = trip_pose(hit.instance - SCENE.traffic.first_instance,
                                    FRAME.previous_cycle_time_s, FRAME.previous_time_s);
      surface.motion =
          before.on_road ? before.position + before.axes * local - surface.position : vec3(0.0);
    } else {
      surface.light = instance.light != NO_HIT ? instance.light : seen.light;
    }
  }
  FRAME.surfaces.at[index] = surface;
}
