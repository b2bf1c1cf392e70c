// A scene's arrays on a device, and the state of its lights.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/gpu/buffer.h"
#include "runtime/render/device_lights.h"
#include "runtime/render/scene_tlas.h"
#include "runtime/scene/render_scene.h"
#include "runtime/scene/scene_traits.h"

namespace nightcity::render {

/// Room for one frame's vehicles: their instances and their part of the BVH, behind the static
/// ones. A renderer holds two, because rays may trace the frame before.
struct VehicleSlot {
  std::uint32_t first_instance, first_bvh_node;  // as in gpu::TrafficBuffers
  std::uint32_t root;                            // of the whole scene with these vehicles
  std::uint64_t instances, bvh;                  // addresses of the first of each
};

/// The sky at the scene's time: as it was loaded times `factor`, and with a map `base` is added
/// above the horizon, cd/m^2.
struct SkyNow {
  glm::vec3 factor{1}, base{0};
};

struct ReleaseGeometry {};

class DeviceScene {
 public:
  /// Copies what set_time needs, so `scene` need not outlive the object. Throws Error, with
  /// the bytes that are needed and those that are free, when the device has too little memory.
  /// The first tables of lights are those of `first`: where the caller knows the time of the first
  /// picture, they need not be made twice.
  DeviceScene(gpu::Device& device, const scene::RenderScene& scene,
              const scene::LightMoment& first = {});
  /// Empties `scene.triangles`, `nodes` and `instances` once the device has them, so that they are
  /// not in memory twice.
  DeviceScene(gpu::Device& device, scene::RenderScene& scene, ReleaseGeometry,
              const scene::LightMoment& first = {});
  DeviceScene(const DeviceScene&) = delete;
  DeviceScene& operator=(const DeviceScene&) = delete;

  /// As DeviceLights does.
  bool set_time(double time_s, scene::LightFamilies on = scene::all_families);
  void switch_when_ready() { lights_->switch_when_ready(); }
  bool switching() const { return lights_->switching(); }
  void edit_light(std::uint32_t index, const Light& light) {
    lights_->edit(index, light);
    has_edited_lights_ = true;
  }
  /// Returns whether lights were edited, here or when the scene was loaded.
  bool has_edited_lights() const { return has_edited_lights_; }
  std::uint32_t light_changes() const { return lights_->changes(); }
  bool has_switches() const { return lights_->has_switches(); }
  std::vector<double> flux_now() const { return lights_->flux_now(); }

  /// Makes buffers() have the light BVH over the static lights from now on.
  void need_light_tree() {
    lights_->need_tree();
    lights_->enter(addresses_);
  }

  const gpu::SceneBuffers& buffers() const { return addresses_; }
  /// Returns what the scene has now: light switches come and go.
  scene::SceneTraits traits() const;
  bool has_textures() const { return addresses_.textures != 0; }
  bool has_traffic() const { return addresses_.traffic.trip_count > 0; }
  bool has_sky_map() const { return addresses_.sky_width > 0; }
  /// Returns what the map of a city's glow has become with the lights that shine now: as bright and
  /// of the colour that they make it, in the distribution that it was made with.
  const SkyNow& sky_now() const { return sky_now_; }
  /// Returns the base colour of a surface by the word of its material: black for an unknown one.
  glm::vec3 albedo(std::uint32_t material) const;
  /// Returns the bounds of the visible static geometry, relative to origin().
  const scene::Box& bounds() const { return bounds_; }
  /// Returns the place in model space, m, that all coordinates on the device are relative to.
  const glm::dvec3& origin() const { return origin_; }
  std::uint64_t bytes() const;
  /// Returns the parts of the scene that were not loaded.
  const scene::PartSet& left_out() const { return left_out_; }

  /// Reserves a slot until release_vehicle_slot(). Reserving one may move the others: ask
  /// vehicle_slot() in every frame.
  std::uint32_t acquire_vehicle_slot();
  void release_vehicle_slot(std::uint32_t slot);
  VehicleSlot vehicle_slot(std::uint32_t slot) const;

  /// Returns the device's acceleration structures, or null where rays go through our own BVHs.
  SceneTlas* tlas() { return tlas_ ? &*tlas_ : nullptr; }

 private:
  DeviceScene(gpu::Device& device, const scene::RenderScene& scene, scene::RenderScene* released,
              const scene::LightMoment& first);
  void store_textures(const scene::RenderScene& scene);
  void store_geometry(const scene::RenderScene& scene, scene::RenderScene* released);
  template <class T>
  std::uint64_t store(std::span<const T> values);
  void store_traffic(const scene::RenderScene& scene, std::span<const gpu::Instance> instances);
  void follow_sky();
  void grow_vehicle_slots(std::uint32_t count);

  gpu::Device& device_;
  std::vector<gpu::Buffer> storage_;
  gpu::SceneBuffers addresses_{};
  scene::SceneTraits loaded_;

  // With traffic: the static instances and nodes, followed by the slots.
  gpu::Buffer instances_, nodes_;
  std::uint32_t static_instances_ = 0, static_nodes_ = 0, slot_nodes_ = 0;
  std::vector<bool> slot_taken_;

  std::vector<glm::vec3> albedos_;
  std::optional<SceneTlas> tlas_;

  std::vector<scene::SkyMap::Share> sky_shares_;
  glm::dvec3 sky_upward_lm_{0};
  float natural_sky_cd_m2_ = 0;
  SkyNow sky_now_;

  scene::Box bounds_;
  glm::dvec3 origin_{0};
  scene::PartSet left_out_;
  bool has_edited_lights_ = false;
  std::optional<DeviceLights> lights_;
};

}  // namespace nightcity::render
