// A scene's lights on a device: which of them shine, and the tables that they are sampled from.
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <optional>
#include <vector>

#include "formats/large_vector.h"
#include "runtime/gpu/buffer.h"
#include "runtime/scene/light_families.h"
#include "runtime/scene/light_grid.h"
#include "runtime/scene/lit_lights.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::render {

class DeviceLights {
 public:
  /// Copies what it needs of `scene`, which must be there until finish(). The lights of `first` are
  /// on, which set_time then finds made. Some of their tables are made in the background until
  /// finish(), which comes before all else.
  DeviceLights(gpu::Device& device, const scene::RenderScene& scene,
               const scene::LightMoment& first);
  /// Makes the other tables and uploads all.
  void finish();

  /// Switches lights by their schedules to `time_s`, in seconds since noon, and those of families
  /// outside `on` off. Returns whether a static light changed. Must not be called while a frame is
  /// being rendered. When lights change, the tables they are sampled from are built anew, which
  /// takes a second with tens of thousands of lights.
  bool set_time(double time_s, scene::LightFamilies on);
  /// Makes set_time build and upload the tables in the background from now on: lights change at the
  /// first call after they are ready.
  void switch_when_ready() { when_ready_ = true; }
  /// Returns whether tables are being built in the background, or edits wait for it.
  bool switching() const { return next_.valid() || !edits_.empty(); }
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
  struct Grid {
    gpu::Buffer cells, entries;
    gpu::LightGridShape shape{};
    std::size_t used_bytes = 0;  // of the entries
  };
  struct Tree {
    gpu::Buffer nodes, leaf_of_light;
    gpu::LightTree tree{};
  };
  struct FirstTables {
    scene::LitLights lit;
    Grid near;
  };
  // The lights that shine and the tables that they are sampled from.
  struct Tables {
    scene::LitLights lit;  // without its tables
    gpu::Buffer bits, list, alias;
    Grid grids[2];  // near, far
    std::optional<Tree> tree;
  };

  void darken_vehicles(scene::LightFamilies on);
  // These may run in the background: they read the static lights alone, and threads take turns at
  // the device.
  Tables make_tables(scene::LitLights lit, bool with_tree) const;
  void upload_lit(scene::LitLights lit, Tables& tables) const;
  Grid make_grid(std::span<const float> flux_lm, scene::LightLists lists) const;
  Tree upload_tree(const scene::LitLights& lit) const;
  void take(Tables next);

  gpu::Device& device_;
  LargeVector<Light> lights_;  // static
  std::vector<LightFamily> families_;
  std::vector<Schedule> schedules_;  // empty where no light uses one
  std::vector<std::uint32_t> switches_;
  std::vector<Light> vehicle_lights_;  // and one more, so that a kind without lights reads memory
  std::map<std::uint32_t, Light> edits_;  // not yet in lights_
  std::uint32_t changes_ = 0;
  bool edited_ = false;  // lights_ is newer than lights_buffer_
  scene::LightFamilies on_ = scene::all_families, vehicles_on_ = scene::all_families;
  gpu::Buffer lights_buffer_, vehicle_lights_buffer_;
  Tables tables_;
  gpu::Buffer bits_before_;  // the last change: the frame before may have used them
  bool needs_tree_ = false;
  bool when_ready_ = false;
  // Both use what is above, so they are destroyed before it.
  std::future<FirstTables> first_;  // until finish()
  std::future<Tables> next_;        // until set_time takes them
};

}  // namespace nightcity::render
