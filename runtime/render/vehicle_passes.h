// The passes that move traffic: each frame they place every vehicle with its lights and rebuild the
// BVH over them. Without traffic they record nothing.
#pragma once

#include <vector>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/compute_pass.h"
#include "runtime/render/device_scene.h"
#include "runtime/render/frame_run.h"
#include "runtime/render/pass_library.h"

namespace nightcity::render {

/// Returns the time within the traffic's cycle, s; 0 without traffic. Seconds since noon are a
/// double, because a float would lose the fractions of frames.
float cycle_time(const TrafficCycle& cycle, double time_s);

/// Returns how many cells a side the map has by which `trips` vehicles are sorted: a power of two,
/// for at least a cell a trip as far as MAX_VEHICLE_CELLS_PER_SIDE goes. Passes over the cells are
/// paid in every frame, so a few vehicles have few.
std::uint32_t choose_vehicle_cells_per_side(std::uint32_t trips);

class VehiclePasses {
 public:
  VehiclePasses(gpu::Device& device, DeviceScene& scene);
  ~VehiclePasses();
  VehiclePasses(const VehiclePasses&) = delete;
  VehiclePasses& operator=(const VehiclePasses&) = delete;

  /// Writes the addresses of this frame's and the previous frame's buffers into `frame`, whose
  /// scene is filled in.
  void enter(gpu::Frame& frame);
  /// Takes the last enter() back: its frame was given up, and the next one follows the same frame.
  void leave() { parity_ ^= 1; }
  /// Returns the passes as steps of a frame. `passes` must outlive them.
  std::vector<FrameStep> list_steps(const PassSet& passes, std::uint64_t frame_address) const;
  /// Returns this frame's lights in model space, VEHICLE_LIGHTS per trip.
  std::vector<Light> lights() const;

 private:
  std::uint32_t count_cells() const { return cells_per_side_ * cells_per_side_; }

  DeviceScene& scene_;
  gpu::Buffer lights_[2], nodes_, boxes_, cells_, counts_;
  std::uint32_t cells_per_side_ = 0;
  std::uint32_t slots_[2]{};
  int parity_ = 0;  // of lights_ and slots_: this frame's; the other is the previous frame's
};

}  // namespace nightcity::render
