#version 460
#extension GL_GOOGLE_include_directive : require
// Primary visibility: what the eye sees in each pixel.
#include "shaders/common.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/hit.glsl"
#include "shaders/eye.glsl"
#include "shaders/fleet.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;

  const Camera camera = FRAME.camera;
  const vec3 direction = eye_direction(pixel);
  Surface surface = Surface(vec3(0.0), 0u, 0.0, 0u, NO_HIT, NO_HIT, vec3(0.0));
  Hit hit;
  if (closest_hit(camera.position, direction, hit)) {
    const vec4 a = SCENE.triangles.at[hit.triangle * 3u];
    const vec4 b = SCENE.triangles.at[hit.triangle * 3u + 1u];
    const vec4 c = SCENE.triangles.at[hit.triangle * 3u + 2u];
    const Instance instance = SCENE.instances.at[hit.instance];
    const vec3 normal = facing_normal(hit, direction);
    surface.position = camera.position + direction * hit.t;
    surface.normal = pack_normal(normal);
    surface.depth = hit.t;
    surface.material = floatBitsToUint(a.w);
    surface.feature = instance.feature != NO_HIT ? instance.feature : floatBitsToUint(b.w);
    const uint own_light = floatBitsToUint(c.w);
    if (HAS_TRAFFIC != 0u && (instance.mask & MASK_FLEET) != 0u) {
      surface.light = own_light < VEHICLE_LIGHTS ? instance.light + own_light : NO_HIT;
      const vec3 local = vec3(dot(instance.to_object[0], vec4(surface.position, 1.0)),
                              dot(instance.to_object[1], vec4(surface.position, 1.0)),
                              dot(instance.to_object[2], vec4(surface.position, 1.0)));
      const Pose before = trip_pose(hit.instance - SCENE.fleet.first_instance, FRAME.previous_cycle_time_s, FRAME.previous_time_s);
      surface.motion = before.on_road ? before.position + before.axes * local - surface.position : vec3(0.0);
    } else {
      surface.light = instance.light != NO_HIT ? instance.light : own_light;
    }
  }
  FRAME.surfaces.at[index] = surface;
}
