#version 460
#extension GL_GOOGLE_include_directive : require
// Fleet, step 1 of 5, an invocation a trip: where the vehicle is now, its instance, its lights, its box, and the cell of the map it
// is sorted by. fleet_counts must be zero.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"
#include "shaders/fleet.glsl"

#define FLEET SCENE.fleet

uint spread_bits(uint x) {  // 8 bits to every second bit
  x = (x | x << 4u) & 0x0F0Fu;
  x = (x | x << 2u) & 0x3333u;
  return (x | x << 1u) & 0x5555u;
}

uint morton_cell(vec3 p) {
  const vec2 extent = max(FLEET.upper.xz - FLEET.lower.xz, vec2(1.0));
  const uvec2 at = uvec2(clamp((p.xz - FLEET.lower.xz) / extent * 256.0, vec2(0.0), vec2(255.0)));
  return spread_bits(at.x) | spread_bits(at.y) << 1u;
}

void main() {
  const uint trip = gl_GlobalInvocationID.x;
  if (trip >= FLEET.trip_count) return;
  const Pose pose = trip_pose(trip, FRAME.cycle_time_s, FRAME.time_s);
  const uint kind = FLEET.trips.at[trip].vehicle;
  const VehicleKind vehicle = FLEET.vehicles.at[kind];
  const VehicleBody body = FLEET.bodies.at[kind];

  float flux = 0.0;
  for (uint i = 0u; i < VEHICLE_LIGHTS; ++i) {
    Light light = FLEET.vehicle_lights.at[vehicle.first_light + min(i, max(vehicle.light_count, 1u) - 1u)];
    const bool shines = pose.on_road && i < vehicle.light_count &&
                        (light.schedule == VEHICLE_LIGHT_ALWAYS || pose.braking);
    light.position = pose.position + pose.axes * light.position;
    light.axis = pose.axes * light.axis;
    light.tangent = pose.axes * light.tangent;
    if (!shines) light.flux_lm = 0.0;
    light.schedule = LIGHT_ALWAYS_ON;
    flux += light.flux_lm;
    FRAME.fleet_lights.at[trip * VEHICLE_LIGHTS + i] = light;
  }

  Instance instance;
  for (uint axis = 0u; axis < 3u; ++axis)
    instance.to_object[axis] = vec4(pose.axes[axis], -dot(pose.axes[axis], pose.position));
  instance.root = body.root;
  instance.mask = pose.on_road ? body.mask | MASK_FLEET : 0u;
  instance.light = SCENE.standing_lights + trip * VEHICLE_LIGHTS;
  instance.feature = NO_HIT;
  FLEET.instances.at[trip] = instance;
  if (FLEET.has_tree != 0u) {
    const uint at = trip * TREE_INSTANCE_WORDS;
    for (uint row = 0u; row < 3u; ++row) {
      const vec4 to_model = vec4(pose.axes[0][row], pose.axes[1][row], pose.axes[2][row], pose.position[row]);
      for (uint i = 0u; i < 4u; ++i) FLEET.tree_instances.at[at + 4u * row + i] = floatBitsToUint(to_model[i]);
    }
    FLEET.tree_instances.at[at + 12u] = (SCENE.fleet.first_instance + trip) | instance.mask << 24u;
    FLEET.tree_instances.at[at + 13u] = 0u;
    FLEET.tree_instances.at[at + 14u] = FLEET.body_trees.at[2u * kind];
    FLEET.tree_instances.at[at + 15u] = FLEET.body_trees.at[2u * kind + 1u];
  }

  FleetNode box = FleetNode(vec3(1e30), 0.0, vec3(-1e30), trip);
  uint cell = FLEET_ABSENT;
  if (pose.on_road) {
    const vec3 centre = pose.position + pose.axes * (0.5 * (body.lower + body.upper));
    const vec3 half_size = 0.5 * (body.upper - body.lower);
    const vec3 reach = abs(pose.axes[0]) * half_size.x + abs(pose.axes[1]) * half_size.y + abs(pose.axes[2]) * half_size.z;
    // As for standing instances, the box makes up for what its corners were rounded by.
    const vec3 margin = 1e-6 * max(abs(centre - reach), abs(centre + reach)) + 1e-6;
    box = FleetNode(centre - reach - margin, flux, centre + reach + margin, trip);
    cell = morton_cell(pose.position);
  }
  FRAME.fleet_boxes.at[trip] = box;
  FRAME.fleet_cells.at[2u * trip] = cell;
  FRAME.fleet_cells.at[2u * trip + 1u] = atomicAdd(FRAME.fleet_counts.at[cell], 1u);
}
