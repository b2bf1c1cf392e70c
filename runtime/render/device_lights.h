// A scene's lights on a device: which of them shine, and the tables that they are sampled from.
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <vector>

#include "runtime/gpu/buffer.h"
#include "runtime/scene/light_families.h"
#include "runtime/scene/lit_lights.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::render {

class DeviceLights {
 public:
  /// Copies what it needs of `scene`. The lights of `first` are on, which set_time then finds made.
  /// Some of their tables are made in the background until finish(), which comes before all else.
  DeviceLights(gpu::Device& device, const scene::RenderScene& scene,
               const scene::LightMoment& first);
  /// Makes the other tables and uploads all.
  void finish();

  /// Switches lights by their schedules to `time_s`, in seconds since noon, and those of families
  /// outside `on` off. Returns whether a static light changed. Must not be called while a frame is
  /// being rendered. When lights change, the tables they are sampled from are built anew, which
  /// takes a second with tens of thousands of lights.
  bool set_time(double time_s, scene::LightFamilies on);
  /// Makes set_time build the tables in the background from now on: lights change at the first call
  /// after they are ready.
  void switch_when_ready() { when_ready_ = true; }
  /// Returns whether tables are being built in the background, or edits wait for it.
  bool switching() const { return next_lit_.valid() || !edits_.empty(); }
  /// Replaces a static light by another one of the same kind, at the next set_time.
  void edit(std::uint32_t index, const Light& light) { edits_[index] = light; }

  /// Makes the light BVH over the static lights, and from now on with every change of them.
  void need_tree();

  /// Returns the number of changes of static lights so far. Reservoirs outlive one, because the
  /// switches before it are kept; so an edit counts as two.
  std::uint32_t changes() const { return changes_; }
  /// Returns whether a static light may be off, so that shaders must ask.
  bool has_switches() const { return !schedules_.empty() || on_ != scene::all_families; }
  /// Returns the current flux of each static light in lumens, 0 where it is off.
  std::vector<double> flux_now() const;
  double flux_now(std::uint32_t light) const;
  std::uint64_t bytes() const;
  /// Enters the addresses of everything that is here.
  void enter(gpu::SceneBuffers& buffers) const;

 private:
  void darken_vehicles(scene::LightFamilies on);
  void upload(scene::LitLights lit);
  void upload_switches(scene::LitLights lit);
  void upload_grid(std::size_t which, const scene::LightGrid& grid);
  void upload_tree();

  gpu::Device& device_;
  std::vector<Light> lights_;  // static
  std::vector<LightFamily> families_;
  std::vector<Schedule> schedules_;  // empty where no light uses one
  std::vector<std::uint32_t> switches_;
  std::vector<Light> vehicle_lights_;  // and one more, so that a kind without lights reads memory
  std::map<std::uint32_t, Light> edits_;  // not yet in lights_
  std::uint32_t changes_ = 0;
  bool edited_ = false;  // lights_ is newer than lights_buffer_
  scene::LightFamilies on_ = scene::all_families, vehicles_on_ = scene::all_families;
  scene::LitLights lit_;
  gpu::Buffer lights_buffer_, vehicle_lights_buffer_;
  // The current switches and those before the last change, which the previous frame may have used.
  gpu::Buffer lit_bits_[2];
  int lit_parity_ = 0;
  gpu::Buffer lit_list_, alias_, cells_[2], entries_[2];  // of the grids: near, far
  gpu::LightGridShape shapes_[2]{};
  bool needs_tree_ = false;
  gpu::LightTree tree_{};
  gpu::Buffer tree_nodes_, leaf_of_light_;
  bool when_ready_ = false;
  std::future<scene::LitLights> first_lit_;  // without its far grid, until finish()
  std::future<scene::LitLights> next_lit_;   // both use lights_, so they are destroyed before it
};

}  // namespace nightcity::render
