// The fleet's share of a frame: every vehicle put where it is at the frame's time, with its lights, and the
// tree over them rebuilt. Without traffic there is nothing of it.
#pragma once

#include <functional>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/compute_pass.h"
#include "runtime/render/device_scene.h"
#include "runtime/render/pass_library.h"

namespace nightcity {

/// Time within the traffic's cycle, s; 0 without traffic. In double until here: seconds since noon want more
/// than a float.
float cycle_time(const TrafficCycle& cycle, double time_s);

class VehiclePasses {
 public:
  VehiclePasses(gpu::Device& device, const DeviceScene& scene);

  /// Enters this frame's buffers, and swaps those of the frame before.
  void enter(gpu::Frame& frame);
  /// Records the passes; `finished` is called after each with its name.
  void record(VkCommandBuffer commands, const PassSet& passes, std::uint64_t frame_address,
              const std::function<void(const char*)>& finished) const;
  /// This frame's lights, VEHICLE_LIGHTS a trip, in model space.
  std::vector<Light> lights() const;

 private:
  const DeviceScene& scene_;
  gpu::Buffer lights_[2], nodes_, boxes_, cells_, counts_;
  int parity_ = 0;
};

}  // namespace nightcity
