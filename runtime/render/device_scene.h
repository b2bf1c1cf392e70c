// A scene's arrays on a device, and which of its lights shine.
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <vector>

#include "runtime/gpu/buffer.h"
#include "runtime/render/ray_trees.h"
#include "runtime/scene/lit_lights.h"
#include "runtime/scene/render_scene.h"

namespace nightcity {

class DeviceScene {
 public:
  /// Keeps what set_time needs of `scene`; the scene itself may go. Throws Error when the device's memory
  /// does not suffice.
  DeviceScene(gpu::Device& device, const RenderScene& scene);
  DeviceScene(const DeviceScene&) = delete;
  DeviceScene& operator=(const DeviceScene&) = delete;

  /// Switches lights as their schedules say for `time_s` seconds after noon; returns whether any changed. Not
  /// while a frame is being rendered. Where some change, the tables they are picked from are made anew, which
  /// takes a second where tens of thousands shine.
  bool set_time(double time_s);
  /// From here on set_time does not wait for those tables: lights change at the call that finds them made.
  void switch_when_ready() { when_ready_ = true; }
  /// Are tables being made?
  bool switching() const { return next_lit_.valid(); }

  const gpu::SceneBuffers& buffers() const { return addresses_; }
  bool has_profiles() const { return has_profiles_; }
  bool has_rectangles() const { return has_rectangles_; }
  bool has_schedules() const { return !schedules_.empty(); }
  bool has_traffic() const { return addresses_.traffic.trip_count > 0; }
  bool has_sky_map() const { return addresses_.sky_width > 0; }
  /// Base colour of a material; black for one that is not there.
  glm::vec3 albedo(std::uint32_t material) const {
    return material < albedos_.size() ? albedos_[material] : glm::vec3(0);
  }
  /// A value a standing light: what it gives now, lumen; 0 where it is off.
  std::vector<double> flux_now() const;
  /// Of what stands and can be seen, model space.
  const Box& bounds() const { return bounds_; }
  std::uint64_t bytes() const;
  /// Where rays go through the device's acceleration structures; else null.
  const RayTrees* trees() const { return trees_ ? &*trees_ : nullptr; }

 private:
  template <class T>
  std::uint64_t store(std::span<const T> values);
  void store_traffic(const RenderScene& scene, std::span<const gpu::Instance> instances);
  void upload_lit(LitLights lit);
  gpu::LightGridBuffers upload_grid(std::size_t which, const LightGrid& grid);

  gpu::Device& device_;
  std::vector<gpu::Buffer> storage_;
  gpu::SceneBuffers addresses_{};
  bool has_profiles_ = false, has_rectangles_ = false;

  std::vector<glm::vec3> albedos_;
  std::optional<RayTrees> trees_;

  // Kept for set_time where lights have schedules.
  std::vector<Light> lights_;
  std::vector<Schedule> schedules_;
  std::vector<std::uint32_t> switches_;
  LitLights lit_;
  std::vector<float> flux_lm_;  // of the standing lights when they shine
  Box bounds_;
  gpu::Buffer lit_bits_
      [2];  // of now and of before the last switch: the frame before may have used the other
  int lit_parity_ = 0;
  gpu::Buffer lit_list_, alias_, cells_[2], entries_[2];  // of the grids: local, wide
  bool when_ready_ = false;
  std::future<LitLights> next_lit_;  // reads lights_, so it goes first
};

}  // namespace nightcity
