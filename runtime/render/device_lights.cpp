#include "runtime/render/device_lights.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "formats/cancel.h"
#include "runtime/scene/alias_table.h"
#include "runtime/scene/light_tree.h"

namespace nightcity::render {

DeviceLights::DeviceLights(gpu::Device& device, const scene::RenderScene& scene,
                           const scene::LightMoment& first)
    : device_(device),
      lights_(scene.lights),
      families_(scene.families),
      vehicle_lights_(scene.traffic.vehicle_lights),
      on_(first.on) {
  // Schedules that no light uses are dropped, so that they cost nothing.
  if (std::any_of(lights_.begin(), lights_.end(),
                  [](const Light& light) { return light.schedule != LIGHT_ALWAYS_ON; })) {
    schedules_ = scene.schedules;
    switches_ = scene.switches;
  }
  lights_buffer_ = gpu::Buffer::of(device_, std::span<const Light>(lights_));
  vehicle_lights_.push_back({});
  vehicle_lights_buffer_ = gpu::Buffer::of(device_, std::span<const Light>(vehicle_lights_));
  darken_vehicles(on_);
  first_lit_ =
      std::async(std::launch::async, [this, time_s = first.time_s, token = find_cancel_token()] {
        const CancelScope scope(token);
        scene::LitLights lit =
            scene::lit_lights(lights_, families_, schedules_, switches_, time_s, on_);
        const std::vector<float> flux = scene::flux_of(lit, lights_);
        lit.alias = scene::build_alias_table(flux);
        lit.near_grid = scene::build_light_grid(lights_, flux, scene::near_lists);
        return lit;
      });
}

void DeviceLights::finish() {
  // One table after the other, so that no two are in memory beside their copies on the device.
  scene::LitLights lit = first_lit_.get();
  ::malloc_trim(0);  // rows of the grid, which the threads that made it have freed
  upload_grid(0, std::exchange(lit.near_grid, {}));
  const std::vector<float> flux = scene::flux_of(lit, lights_);
  upload_switches(std::move(lit));
  upload_grid(1, scene::build_light_grid(lights_, flux, scene::far_lists));
}

void DeviceLights::darken_vehicles(scene::LightFamilies on) {
  if (vehicles_on_ == on) return;
  vehicles_on_ = on;
  const std::vector<Light> lights = scene::darkened(vehicle_lights_, on);
  vehicle_lights_buffer_.upload(lights.data(), lights.size() * sizeof(Light));
}

bool DeviceLights::set_time(double time_s, scene::LightFamilies on) {
  darken_vehicles(on);
  if (next_lit_.valid()) {
    if (next_lit_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    upload(next_lit_.get());
    return true;
  }
  if (lit_.steady.has(time_s) && on == on_ && edits_.empty()) return false;
  on_ = on;
  for (const auto& [index, light] : std::exchange(edits_, {})) {
    if (index >= lights_.size()) continue;
    lights_[index] = light;
    edited_ = true;
  }
  scene::LitLights lit = scene::lit_lights(lights_, families_, schedules_, switches_, time_s, on);
  if (!edited_ && lit.same_lights(lit_)) {
    lit_.steady = lit.steady;
    return false;
  }
  const auto with_tables = [this](scene::LitLights of) {
    scene::build_tables(of, lights_);
    return of;
  };
  if (when_ready_) {
    next_lit_ = std::async(std::launch::async, with_tables, std::move(lit));
    return false;
  }
  upload(with_tables(std::move(lit)));
  return true;
}

void DeviceLights::upload(scene::LitLights lit) {
  changes_ += edited_ ? 2 : 1;
  if (std::exchange(edited_, false))
    lights_buffer_.upload(lights_.data(), lights_.size() * sizeof(Light));
  upload_grid(0, std::exchange(lit.near_grid, {}));
  upload_grid(1, std::exchange(lit.far_grid, {}));
  upload_switches(std::move(lit));
}

void DeviceLights::upload_switches(scene::LitLights lit) {
  lit_ = std::move(lit);
  lit_parity_ ^= 1;
  lit_bits_[lit_parity_] = gpu::Buffer::of(device_, std::span<const std::uint32_t>(lit_.bits));
  lit_list_ = gpu::Buffer::of(device_, std::span<const std::uint32_t>(lit_.list));
  alias_ = gpu::Buffer::of(device_, std::span<const gpu::AliasEntry>(lit_.alias));
  // The device has the table now; the switches are kept to detect the next change.
  lit_.alias = {};
  if (needs_tree_) upload_tree();
}

void DeviceLights::need_tree() {
  if (std::exchange(needs_tree_, true)) return;
  upload_tree();
}

void DeviceLights::upload_tree() {
  const scene::LightTree tree = scene::build_light_tree(lights_, lit_.list);
  tree_nodes_ = gpu::Buffer::of(device_, std::span<const gpu::LightNode>(tree.nodes));
  leaf_of_light_ = gpu::Buffer::of(device_, std::span<const std::uint32_t>(tree.leaf_of_light));
  tree_ = tree.shape;
  tree_.nodes = tree_nodes_.address();
  tree_.leaf_of_light = leaf_of_light_.address();
}

void DeviceLights::upload_grid(std::size_t which, const scene::LightGrid& grid) {
  cells_[which] = gpu::Buffer::of(device_, std::span<const gpu::LightCell>(grid.cells));
  entries_[which] = gpu::Buffer::of(device_, std::span<const gpu::GridEntry>(grid.entries));
  shapes_[which] = grid.shape;
}

void DeviceLights::enter(gpu::SceneBuffers& buffers) const {
  buffers.lights = lights_buffer_.address();
  buffers.traffic.vehicle_lights = vehicle_lights_buffer_.address();
  buffers.lit = lit_bits_[lit_parity_].address();
  buffers.lit_list = lit_list_.address();
  buffers.lit_count = static_cast<std::uint32_t>(lit_.list.size());
  buffers.alias = alias_.address();
  buffers.near_grid = {shapes_[0], cells_[0].address(), entries_[0].address()};
  buffers.far_grid = {shapes_[1], cells_[1].address(), entries_[1].address()};
  buffers.light_tree = tree_;
}

std::vector<double> DeviceLights::flux_now() const {
  std::vector<double> flux(lights_.size());
  for (const std::uint32_t i : lit_.list) flux[i] = double(lights_[i].flux_lm);
  return flux;
}

double DeviceLights::flux_now(std::uint32_t light) const {
  const bool shines = (lit_.bits[light / 32] >> (light % 32)) & 1;
  return shines ? double{lights_[light].flux_lm} : 0;
}

std::uint64_t DeviceLights::bytes() const {
  std::uint64_t total = 0;
  for (const gpu::Buffer* buffer :
       {&lights_buffer_, &vehicle_lights_buffer_, &lit_bits_[0], &lit_bits_[1], &lit_list_, &alias_,
        &cells_[0], &cells_[1], &entries_[0], &entries_[1], &tree_nodes_, &leaf_of_light_})
    total += buffer->bytes();
  return total;
}

}  // namespace nightcity::render
