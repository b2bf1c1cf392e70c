#include "runtime/render/fleet_passes.h"

#include <cmath>

namespace nightcity {

float cycle_time(const TrafficCycle& cycle, double time_s) {
  const double length = double(cycle.cycle_s);
  return length > 0 ? float(time_s - std::floor(time_s / length) * length) : 0.0f;
}

FleetPasses::FleetPasses(gpu::Device& device, const DeviceScene& scene) : scene_(scene) {
  if (!scene.has_fleet()) return;
  const gpu::FleetBuffers& fleet = scene.buffers().fleet;
  const std::size_t trips = fleet.trip_count;
  for (gpu::Buffer& lights : lights_)
    lights = gpu::Buffer(device, trips * VEHICLE_LIGHTS * sizeof(Light));
  const std::uint32_t last = fleet.levels - 1;
  nodes_ = gpu::Buffer(device, (fleet.level_first[last] + std::size_t{fleet.level_count[last]}) *
                                   sizeof(gpu::FleetNode));
  boxes_ = gpu::Buffer(device, trips * sizeof(gpu::FleetNode));
  cells_ = gpu::Buffer(device, trips * 2 * sizeof(std::uint32_t));
  counts_ = gpu::Buffer(device, (FLEET_CELLS + 1) * sizeof(std::uint32_t));
}

void FleetPasses::enter(gpu::Frame& frame) {
  parity_ ^= 1;
  frame.fleet_lights = lights_[parity_].address();
  frame.previous_fleet_lights = lights_[parity_ ^ 1].address();
  frame.fleet_nodes = nodes_.address();
  frame.fleet_boxes = boxes_.address();
  frame.fleet_cells = cells_.address();
  frame.fleet_counts = counts_.address();
}

void FleetPasses::record(VkCommandBuffer commands, const PassSet& passes,
                         std::uint64_t frame_address,
                         const std::function<void(const char*)>& finished) const {
  if (!scene_.has_fleet()) return;
  const gpu::FleetBuffers& fleet = scene_.buffers().fleet;
  const auto run = [&](const gpu::ComputePass& pass, std::uint32_t invocations,
                       std::uint32_t level = 0) {
    const gpu::Push push{frame_address, level, 0};
    pass.dispatch(commands, &push, invocations);
    gpu::full_barrier(commands);
  };
  vkCmdFillBuffer(commands, counts_.handle(), 0, VK_WHOLE_SIZE, 0);
  gpu::full_barrier(commands);
  run(passes.fleet_pose, fleet.trip_count);
  finished("fleet poses");
  run(passes.fleet_offsets, 1);
  run(passes.fleet_order, fleet.trip_count);
  run(passes.fleet_settle, FLEET_CELLS);
  // The last dispatch, one past the levels, joins the fleet and what stands.
  for (std::uint32_t level = 1; level <= fleet.levels; ++level)
    run(passes.fleet_tree, level < fleet.levels ? fleet.level_count[level] : 1, level);
  finished("fleet tree");
  if (!scene_.trees()) return;
  scene_.trees()->build(commands);
  finished("top level");
}

std::vector<Light> FleetPasses::lights() const {
  return lights_[parity_].read<Light>(scene_.buffers().fleet.trip_count *
                                      std::size_t{VEHICLE_LIGHTS});
}

}  // namespace nightcity
