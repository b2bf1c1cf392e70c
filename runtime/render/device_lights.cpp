#include "runtime/render/device_lights.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "formats/cancel.h"
#include "formats/free_memory.h"
#include "runtime/scene/alias_table.h"
#include "runtime/scene/light_tree.h"

namespace nightcity::render {

DeviceLights::DeviceLights(gpu::Device& device, const scene::RenderScene& scene,
                           const scene::LightMoment& first)
    : device_(device),
      families_(scene.families),
      vehicle_lights_(scene.traffic.vehicle_lights),
      on_(first.on) {
  // Schedules that no light uses are dropped, so that they cost nothing.
  if (std::any_of(scene.lights.begin(), scene.lights.end(),
                  [](const Light& light) { return light.schedule != LIGHT_ALWAYS_ON; })) {
    schedules_ = scene.schedules;
    switches_ = scene.switches;
  }
  lights_buffer_ = gpu::Buffer::of(device_, std::span(scene.lights));
  vehicle_lights_.push_back({});
  vehicle_lights_buffer_ = gpu::Buffer::of(device_, std::span<const Light>(vehicle_lights_));
  darken_vehicles(on_);
  first_ = std::async(
      std::launch::async, [this, &scene, time_s = first.time_s, token = find_cancel_token()] {
        const CancelScope scope(token);
        lights_ = scene.lights;
        FirstTables first{scene::lit_lights(lights_, families_, schedules_, switches_, time_s, on_),
                          {}};
        const std::vector<float> flux = scene::flux_of(first.lit, lights_);
        first.lit.alias = scene::build_alias_table(flux);
        first.near = make_grid(flux, scene::near_lists);
        return first;
      });
}

void DeviceLights::finish() {
  FirstTables first = first_.get();
  ::malloc_trim(0);  // rows of the grid, which the threads that made it have freed
  tables_.grids[0] = std::move(first.near);
  const std::vector<float> flux = scene::flux_of(first.lit, lights_);
  upload_lit(std::move(first.lit), tables_);
  tables_.grids[1] = make_grid(flux, scene::far_lists);
}

void DeviceLights::darken_vehicles(scene::LightFamilies on) {
  if (vehicles_on_ == on) return;
  vehicles_on_ = on;
  const std::vector<Light> lights = scene::darkened(vehicle_lights_, on);
  vehicle_lights_buffer_.upload(lights.data(), lights.size() * sizeof(Light));
}

bool DeviceLights::set_time(double time_s, scene::LightFamilies on) {
  darken_vehicles(on);
  if (next_.valid()) {
    if (next_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    take(next_.get());
    return true;
  }
  if (tables_.lit.steady.has(time_s) && on == on_ && edits_.empty()) return false;
  on_ = on;
  for (const auto& [index, light] : std::exchange(edits_, {})) {
    if (index >= lights_.size()) continue;
    lights_[index] = light;
    edited_ = true;
  }
  scene::LitLights lit = scene::lit_lights(lights_, families_, schedules_, switches_, time_s, on);
  if (!edited_ && lit.same_lights(tables_.lit)) {
    tables_.lit.steady = lit.steady;
    return false;
  }
  if (when_ready_) {
    next_ = std::async(
        std::launch::async,
        [this, with_tree = needs_tree_](scene::LitLights of) {
          return make_tables(std::move(of), with_tree);
        },
        std::move(lit));
    return false;
  }
  take(make_tables(std::move(lit), needs_tree_));
  return true;
}

DeviceLights::Tables DeviceLights::make_tables(scene::LitLights lit, bool with_tree) const {
  const std::vector<float> flux = scene::flux_of(lit, lights_);
  lit.alias = scene::build_alias_table(flux);
  Tables tables;
  // One grid after the other, so that no two are in memory beside their copies on the device.
  tables.grids[0] = make_grid(flux, scene::near_lists);
  tables.grids[1] = make_grid(flux, scene::far_lists);
  if (with_tree) tables.tree = upload_tree(lit);
  upload_lit(std::move(lit), tables);
  return tables;
}

void DeviceLights::take(Tables next) {
  changes_ += edited_ ? 2 : 1;
  if (std::exchange(edited_, false))
    lights_buffer_.upload(lights_.data(), lights_.size() * sizeof(Light));
  bits_before_ = std::move(tables_.bits);
  tables_ = std::move(next);
  if (needs_tree_ && !tables_.tree) tables_.tree = upload_tree(tables_.lit);
}

void DeviceLights::upload_lit(scene::LitLights lit, Tables& tables) const {
  tables.bits = gpu::Buffer::of(device_, std::span<const std::uint32_t>(lit.bits));
  tables.list = gpu::Buffer::of(device_, std::span<const std::uint32_t>(lit.list));
  tables.alias = gpu::Buffer::of(device_, std::span<const gpu::AliasEntry>(lit.alias));
  // The device has the table now; the switches are kept to detect the next change.
  free_memory(lit.alias);
  tables.lit = std::move(lit);
}

void DeviceLights::need_tree() {
  if (std::exchange(needs_tree_, true)) return;
  tables_.tree = upload_tree(tables_.lit);
}

DeviceLights::Tree DeviceLights::upload_tree(const scene::LitLights& lit) const {
  const scene::LightTree tree = scene::build_light_tree(lights_, lit.list);
  Tree result{gpu::Buffer::of(device_, std::span<const gpu::LightNode>(tree.nodes)),
              gpu::Buffer::of(device_, std::span<const std::uint32_t>(tree.leaf_of_light)),
              tree.shape};
  result.tree.nodes = result.nodes.address();
  result.tree.leaf_of_light = result.leaf_of_light.address();
  return result;
}

DeviceLights::Grid DeviceLights::make_grid(std::span<const float> flux_lm,
                                           scene::LightLists lists) const {
  Grid result;
  scene::LightGrid grid;
  std::size_t used = 0;
  const bool is_host_memory =
      device_.info().kind == "cpu" && gpu::Buffer(device_, 0).map_first() != nullptr;
  if (is_host_memory) {
    // The entries are made where they will be read. Room for full lists costs nothing there: memory
    // that is not written to is not taken.
    result.entries = gpu::Buffer(device_, 0);
    used = scene::fill_light_grid(
        lights_, flux_lm, lists,
        [&](std::size_t most) {
          result.entries = gpu::Buffer(device_, most * sizeof(gpu::GridEntry));
          return std::span(static_cast<gpu::GridEntry*>(result.entries.map_first()), most);
        },
        grid);
  } else {
    grid = scene::build_light_grid(lights_, flux_lm, lists);
    result.entries = gpu::Buffer::of(device_, std::span<const gpu::GridEntry>(grid.entries));
    used = grid.entries.size();
  }
  result.used_bytes = used * sizeof(gpu::GridEntry);
  result.cells = gpu::Buffer::of(device_, std::span<const gpu::LightCell>(grid.cells));
  result.shape = grid.shape;
  return result;
}

void DeviceLights::enter(gpu::SceneBuffers& buffers) const {
  buffers.lights = lights_buffer_.address();
  buffers.traffic.vehicle_lights = vehicle_lights_buffer_.address();
  buffers.lit = tables_.bits.address();
  buffers.lit_list = tables_.list.address();
  buffers.lit_count = static_cast<std::uint32_t>(tables_.lit.list.size());
  buffers.lit_flux_lm = static_cast<float>(tables_.lit.flux_lm);
  buffers.alias = tables_.alias.address();
  const auto address_of = [](const Grid& grid) {
    return gpu::LightGridBuffers{grid.shape, grid.cells.address(), grid.entries.address()};
  };
  buffers.near_grid = address_of(tables_.grids[0]);
  buffers.far_grid = address_of(tables_.grids[1]);
  buffers.light_tree = tables_.tree ? tables_.tree->tree : gpu::LightTree{};
}

std::vector<double> DeviceLights::flux_now() const {
  std::vector<double> flux(lights_.size());
  for (const std::uint32_t i : tables_.lit.list) flux[i] = double(lights_[i].flux_lm);
  return flux;
}

double DeviceLights::flux_now(std::uint32_t light) const {
  const bool shines = (tables_.lit.bits[light / 32] >> (light % 32)) & 1;
  return shines ? double{lights_[light].flux_lm} : 0;
}

std::uint64_t DeviceLights::bytes() const {
  std::uint64_t total = 0;
  for (const gpu::Buffer* buffer : {&lights_buffer_, &vehicle_lights_buffer_, &bits_before_,
                                    &tables_.bits, &tables_.list, &tables_.alias})
    total += buffer->bytes();
  for (const Grid& grid : tables_.grids) total += grid.cells.bytes() + grid.used_bytes;
  if (tables_.tree) total += tables_.tree->nodes.bytes() + tables_.tree->leaf_of_light.bytes();
  return total;
}

}  // namespace nightcity::render
