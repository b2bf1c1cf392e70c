// A scene's arrays on a device, and the state of its lights.
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <vector>

#include "runtime/gpu/buffer.h"
#include "runtime/render/scene_tlas.h"
#include "runtime/scene/lit_lights.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::render {

/// Room for one frame's vehicles: their instances and their part of the BVH, behind the static
/// ones. A renderer holds two, because rays may trace the frame before.
struct VehicleSlot {
  std::uint32_t first_instance, first_bvh_node;  // as in gpu::TrafficBuffers
  std::uint32_t root;                            // of the whole scene with these vehicles
  std::uint64_t instances, bvh;                  // addresses of the first of each
};

struct ReleaseGeometry {};

class DeviceScene {
 public:
  /// Copies what set_time needs, so `scene` need not outlive the object. Throws Error, with
  /// the bytes that are needed and those that are free, when the device has too little memory.
  DeviceScene(gpu::Device& device, const scene::RenderScene& scene);
  /// Empties `scene.triangles`, `nodes` and `instances` once the device has them, so that they are
  /// not in memory twice.
  DeviceScene(gpu::Device& device, scene::RenderScene& scene, ReleaseGeometry);
  DeviceScene(const DeviceScene&) = delete;
  DeviceScene& operator=(const DeviceScene&) = delete;

  /// Switches lights by their schedules to `time_s`, in seconds since noon, and returns whether any
  /// changed. Must not be called while a frame is being rendered. When lights change, the tables
  /// they are sampled from are rebuilt, which takes a second with tens of thousands of lights.
  bool set_time(double time_s);
  /// Makes set_time build those tables in the background from now on: lights change at the first
  /// call after they are ready.
  void switch_when_ready() { when_ready_ = true; }
  /// Returns whether tables are being built in the background.
  bool switching() const { return next_lit_.valid(); }

  const gpu::SceneBuffers& buffers() const { return addresses_; }
  bool has_profiles() const { return has_profiles_; }
  bool has_rectangles() const { return has_rectangles_; }
  /// Returns whether a surface is as smooth as water.
  bool has_water() const { return has_water_; }
  bool has_schedules() const { return !schedules_.empty(); }
  bool has_traffic() const { return addresses_.traffic.trip_count > 0; }
  bool has_sky_map() const { return addresses_.sky_width > 0; }
  /// Returns the base colour of a material, black for an unknown one.
  glm::vec3 albedo(std::uint32_t material) const {
    return material < albedos_.size() ? albedos_[material] : glm::vec3(0);
  }
  /// Returns the current flux of each static light in lumens, 0 where it is off.
  std::vector<double> flux_now() const;
  /// Returns the bounds of the visible static geometry in model space.
  const scene::Box& bounds() const { return bounds_; }
  std::uint64_t bytes() const;

  /// Reserves a slot until release_vehicle_slot(). Reserving one may move the others: ask
  /// vehicle_slot() in every frame.
  std::uint32_t acquire_vehicle_slot();
  void release_vehicle_slot(std::uint32_t slot);
  VehicleSlot vehicle_slot(std::uint32_t slot) const;

  /// Returns the device's acceleration structures, or null where rays go through our own BVHs.
  SceneTlas* tlas() { return tlas_ ? &*tlas_ : nullptr; }

 private:
  DeviceScene(gpu::Device& device, const scene::RenderScene& scene, scene::RenderScene* released);
  void store_geometry(const scene::RenderScene& scene, scene::RenderScene* released);
  template <class T>
  std::uint64_t store(std::span<const T> values);
  void store_traffic(const scene::RenderScene& scene, std::span<const gpu::Instance> instances);
  void grow_vehicle_slots(std::uint32_t count);
  void upload_lit(scene::LitLights lit);
  void upload_switches(scene::LitLights lit);
  gpu::LightGridBuffers upload_grid(std::size_t which, const scene::LightGrid& grid);

  gpu::Device& device_;
  std::vector<gpu::Buffer> storage_;
  gpu::SceneBuffers addresses_{};
  bool has_profiles_ = false, has_rectangles_ = false, has_water_ = false;

  // With traffic: the static instances and nodes, followed by the slots.
  gpu::Buffer instances_, nodes_;
  std::uint32_t static_instances_ = 0, static_nodes_ = 0, slot_nodes_ = 0;
  std::vector<bool> slot_taken_;

  std::vector<glm::vec3> albedos_;
  std::optional<SceneTlas> tlas_;

  // Kept for set_time when lights have schedules.
  std::vector<Light> lights_;
  std::vector<Schedule> schedules_;
  std::vector<std::uint32_t> switches_;
  scene::LitLights lit_;
  std::vector<float> flux_lm_;  // of the static lights when they shine
  scene::Box bounds_;
  // The current switches and those before the last change, which the previous frame may have used.
  gpu::Buffer lit_bits_[2];
  int lit_parity_ = 0;
  gpu::Buffer lit_list_, alias_, cells_[2], entries_[2];  // of the grids: near, far
  bool when_ready_ = false;
  std::future<scene::LitLights> next_lit_;  // uses lights_, so it is declared last: destroyed first
};

}  // namespace nightcity::render
