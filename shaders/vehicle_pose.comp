#version 460
#extension GL_GOOGLE_include_directive : require
// Vehicles, step 1 of 5, one invocation per trip: finds where the vehicle is now, and writes its
// instance, its lights, its box, and the cell of the map that it is sorted by. vehicle_counts must
// be zero.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"
#include "shaders/trip_pose.glsl"
#include "shaders/vehicle_cells.glsl"

#define TRAFFIC SCENE.traffic

void main() {
  const uint trip = gl_GlobalInvocationID.x;
  if (trip >= TRAFFIC.trip_count) return;
  const Pose pose = trip_pose(trip, FRAME.cycle_time_s, FRAME.time_s);
  const uint kind = TRAFFIC.trips.at[trip].vehicle;
  const VehicleKind vehicle = TRAFFIC.vehicles.at[kind];
  const VehicleBody body = TRAFFIC.bodies.at[kind];

  float flux = 0.0;
  for (uint i = 0u; i < VEHICLE_LIGHTS; ++i) {
    Light light =
        TRAFFIC.vehicle_lights.at[vehicle.first_light + min(i, max(vehicle.light_count, 1u) - 1u)];
    const bool shines = pose.on_road && i < vehicle.light_count &&
                        (light.schedule == VEHICLE_LIGHT_ALWAYS || pose.braking);
    light.position = pose.position + pose.axes * light.position;
    light.axis = pose.axes * light.axis;
    light.tangent = pose.axes * light.tangent;
    if (!shines) light.flux_lm = 0.0;
    light.schedule = LIGHT_ALWAYS_ON;
    flux += light.flux_lm;
    FRAME.vehicle_lights.at[trip * VEHICLE_LIGHTS + i] = light;
  }

  Instance instance;
  for (uint axis = 0u; axis < 3u; ++axis)
    instance.to_object[axis] = vec4(pose.axes[axis], -dot(pose.axes[axis], pose.position));
  instance.root = body.root;
  instance.mask = pose.on_road ? body.mask | MASK_VEHICLE : 0u;
  instance.light = SCENE.static_lights + trip * VEHICLE_LIGHTS;
  instance.feature = NO_HIT;
  TRAFFIC.instances.at[trip] = instance;
  if (TRAFFIC.has_tlas != 0u) {
    const uint at = trip * TLAS_INSTANCE_WORDS;
    for (uint row = 0u; row < 3u; ++row) {
      const vec4 to_model =
          vec4(pose.axes[0][row], pose.axes[1][row], pose.axes[2][row], pose.position[row]);
      for (uint i = 0u; i < 4u; ++i)
        TRAFFIC.tlas_instances.at[at + 4u * row + i] = floatBitsToUint(to_model[i]);
    }
    TRAFFIC.tlas_instances.at[at + 12u] = (SCENE.traffic.first_instance + trip) | instance.mask
                                                                                      << 24u;
    TRAFFIC.tlas_instances.at[at + 13u] = 0u;
    TRAFFIC.tlas_instances.at[at + 14u] = TRAFFIC.body_blas.at[2u * kind];
    TRAFFIC.tlas_instances.at[at + 15u] = TRAFFIC.body_blas.at[2u * kind + 1u];
  }

  LightNode box = LightNode(vec3(1e30), 0.0, vec3(-1e30), trip);
  uint cell = vehicle_cells();
  if (pose.on_road) {
    const vec3 centre =
        turn_to_boxes(pose.position + pose.axes * (0.5 * (body.lower + body.upper)));
    const vec3 half_size = 0.5 * (body.upper - body.lower);
    const vec3 reach = abs(turn_to_boxes(pose.axes[0])) * half_size.x +
                       abs(turn_to_boxes(pose.axes[1])) * half_size.y +
                       abs(turn_to_boxes(pose.axes[2])) * half_size.z;
    // As for static instances, the margin makes up for the rounding of the box's corners.
    const vec3 margin =
        1e-6 * max(abs(centre - reach), abs(centre + reach)) + 1e-6 + SCENE.boxes_margin_m;
    box = LightNode(centre - reach - margin, flux, centre + reach + margin, trip);
    cell = vehicle_cell(turn_to_boxes(pose.position));
  }
  FRAME.vehicle_boxes.at[trip] = box;
  FRAME.vehicle_cells.at[2u * trip] = cell;
  FRAME.vehicle_cells.at[2u * trip + 1u] = atomicAdd(FRAME.vehicle_counts.at[cell], 1u);
}
