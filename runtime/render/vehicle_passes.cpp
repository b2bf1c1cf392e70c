#include "runtime/render/vehicle_passes.h"

#include <cmath>

namespace nightcity::render {

float cycle_time(const TrafficCycle& cycle, double time_s) {
  const double length = double(cycle.cycle_s);
  return length > 0 ? float(time_s - std::floor(time_s / length) * length) : 0.0f;
}

std::uint32_t choose_vehicle_cells_per_side(std::uint32_t trips) {
  std::uint32_t side = 1;
  while (side < MAX_VEHICLE_CELLS_PER_SIDE && side * side < trips) side *= 2;
  return side;
}

VehiclePasses::VehiclePasses(gpu::Device& device, DeviceScene& scene) : scene_(scene) {
  if (!scene.has_traffic()) return;
  const gpu::TrafficBuffers& traffic = scene.buffers().traffic;
  const std::size_t trips = traffic.trip_count;
  cells_per_side_ = choose_vehicle_cells_per_side(traffic.trip_count);
  for (gpu::Buffer& lights : lights_)
    lights = gpu::Buffer(device, trips * VEHICLE_LIGHTS * sizeof(Light));
  const std::uint32_t last = traffic.levels - 1;
  nodes_ =
      gpu::Buffer(device, (traffic.level_first[last] + std::size_t{traffic.level_count[last]}) *
                              sizeof(gpu::LightNode));
  boxes_ = gpu::Buffer(device, trips * sizeof(gpu::LightNode));
  cells_ = gpu::Buffer(device, trips * 2 * sizeof(std::uint32_t));
  counts_ = gpu::Buffer(device, (count_cells() + std::size_t{1}) * sizeof(std::uint32_t));
  for (std::uint32_t& slot : slots_) slot = scene_.acquire_vehicle_slot();
}

VehiclePasses::~VehiclePasses() {
  if (!scene_.has_traffic()) return;
  for (const std::uint32_t slot : slots_) scene_.release_vehicle_slot(slot);
}

void VehiclePasses::enter(gpu::Frame& frame) {
  parity_ ^= 1;
  frame.vehicle_lights = lights_[parity_].address();
  frame.previous_vehicle_lights = lights_[parity_ ^ 1].address();
  frame.vehicle_nodes = nodes_.address();
  frame.vehicle_boxes = boxes_.address();
  frame.vehicle_cells = cells_.address();
  frame.vehicle_counts = counts_.address();
  frame.previous_root = frame.scene.root;
  frame.previous_tlas = frame.scene.tlas;
  if (!scene_.has_traffic()) return;
  const VehicleSlot now = scene_.vehicle_slot(slots_[parity_]);
  frame.scene.root = now.root;
  frame.scene.traffic.first_instance = now.first_instance;
  frame.scene.traffic.first_bvh_node = now.first_bvh_node;
  frame.scene.traffic.cells_per_side = cells_per_side_;
  frame.scene.traffic.instances = now.instances;
  frame.scene.traffic.bvh = now.bvh;
  frame.previous_root = scene_.vehicle_slot(slots_[parity_ ^ 1]).root;
  if (!scene_.tlas()) return;
  const SceneTlas::TopLevel& top_level = scene_.tlas()->top_level(slots_[parity_]);
  frame.scene.tlas = to_words(top_level.address());
  frame.scene.traffic.tlas_instances = top_level.trip_instances();
  frame.previous_tlas = to_words(scene_.tlas()->top_level(slots_[parity_ ^ 1]).address());
}

std::vector<FrameStep> VehiclePasses::list_steps(const PassSet& passes,
                                                 std::uint64_t frame_address) const {
  if (!scene_.has_traffic()) return {};
  const auto run = [frame_address](VkCommandBuffer commands, const gpu::ComputePass& pass,
                                   std::uint32_t invocations, std::uint32_t level = 0) {
    const gpu::Push push{frame_address, level, 0};
    pass.dispatch(commands, &push, invocations);
    gpu::full_barrier(commands);
  };
  std::vector<FrameStep> steps;
  steps.push_back({"vehicle poses", 1, [this, &passes, run](VkCommandBuffer commands, auto, auto) {
                     vkCmdFillBuffer(commands, counts_.handle(), 0, VK_WHOLE_SIZE, 0);
                     gpu::full_barrier(commands);
                     run(commands, passes.vehicle_pose, scene_.buffers().traffic.trip_count);
                   }});
  steps.push_back({"vehicle BVH", 1, [this, &passes, run](VkCommandBuffer commands, auto, auto) {
                     const gpu::TrafficBuffers& traffic = scene_.buffers().traffic;
                     run(commands, passes.vehicle_offsets, 1);
                     run(commands, passes.vehicle_order, traffic.trip_count);
                     run(commands, passes.vehicle_sort_cells, count_cells());
                     // The last dispatch, one past the levels, joins the BVH of the vehicles and
                     // the static one.
                     for (std::uint32_t level = 1; level <= traffic.levels; ++level)
                       run(commands, passes.vehicle_bvh,
                           level < traffic.levels ? traffic.level_count[level] : 1, level);
                   }});
  if (scene_.tlas())
    steps.push_back({"top level", 1, [this](VkCommandBuffer commands, auto, auto) {
                       scene_.tlas()->top_level(slots_[parity_]).build(commands);
                     }});
  return steps;
}

std::vector<Light> VehiclePasses::lights() const {
  return lights_[parity_].read<Light>(scene_.buffers().traffic.trip_count *
                                      std::size_t{VEHICLE_LIGHTS});
}

}  // namespace nightcity::render
