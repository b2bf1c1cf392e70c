#include "runtime/render/device_scene.h"

#include <algorithm>

#include "formats/error.h"
#include "formats/free_memory.h"
#include "formats/srgb.h"
#include "runtime/render/device_triangles.h"

namespace nightcity::render {
namespace {

// Two renderers often share a scene: one is compared with the other.
constexpr std::uint32_t usual_vehicle_slots = 4;

// Throws Error before anything is uploaded if what the scene needs at least is more than there is.
// The lists of light grids and the device's own acceleration structures come on top.
void check_memory(const gpu::Device& device, const scene::RenderScene& scene) {
  const auto bytes_of = [](const auto& values) {
    return std::uint64_t{values.size()} * sizeof values[0];
  };
  const std::uint64_t needed = count_device_triangles(device, scene) * sizeof(gpu::Triangle) +
                               bytes_of(scene.nodes) + bytes_of(scene.instances) +
                               bytes_of(scene.lights) +
                               scene.lights.size() * sizeof(gpu::AliasEntry) +
                               bytes_of(scene.texels),
                      free = device.free_memory();
  if (needed > free)
    throw Error("scene", "needs at least " + std::to_string(needed) +
                             " bytes of memory on device '" + device.info().name + "', where " +
                             std::to_string(free) +
                             " are free: take another one (--device), or bake a smaller area");
}

}  // namespace

template <class T>
std::uint64_t DeviceScene::store(std::span<const T> values) {
  storage_.push_back(gpu::Buffer::of(device_, values));
  return storage_.back().address();
}

DeviceScene::DeviceScene(gpu::Device& device, const scene::RenderScene& scene,
                         const scene::LightMoment& first)
    : DeviceScene(device, scene, nullptr, first) {}

DeviceScene::DeviceScene(gpu::Device& device, scene::RenderScene& scene, ReleaseGeometry,
                         const scene::LightMoment& first)
    : DeviceScene(device, scene, &scene, first) {}

DeviceScene::DeviceScene(gpu::Device& device, const scene::RenderScene& scene,
                         scene::RenderScene* released, const scene::LightMoment& first)
    : device_(device) {
  check_memory(device, scene);
  loaded_ = scene::find_traits(scene);
  lights_.emplace(device_, scene, first);  // makes tables while the geometry is stored
  if (!scene.textures.empty()) store_textures(scene);
  store_geometry(scene, released);
  addresses_.materials = store(std::span(scene.materials));
  addresses_.profiles = store(std::span(scene.profiles));
  addresses_.profile_data = store(std::span(scene.profile_data));
  for (const gpu::Material& material : scene.materials) albedos_.push_back(material.base_colour);
  if (scene.sky_map.width > 0) {
    addresses_.sky_map = store(std::span(scene.sky_map.rgb));
    addresses_.sky_width = scene.sky_map.width;
    addresses_.sky_height = scene.sky_map.height;
    sky_shares_ = scene.sky_map.shares;
    sky_upward_lm_ = scene.sky_map.upward_lm;
    natural_sky_cd_m2_ = scene.sky_map.natural_cd_m2;
  }
  bounds_ = scene.bounds;
  origin_ = scene.origin;
  lights_->finish();
  lights_->enter(addresses_);
  follow_sky();
  left_out_ = scene.left_out;
  has_edited_lights_ = scene.has_edited_lights;
}

scene::SceneTraits DeviceScene::traits() const {
  scene::SceneTraits traits = loaded_;
  traits.schedules = has_switches();
  return traits;
}

glm::vec3 DeviceScene::albedo(std::uint32_t material) const {
  if (!has_textures() || (material & MATERIAL_IS_COLOUR) == 0)
    return material < albedos_.size() ? albedos_[material] : glm::vec3(0);
  const auto channel = [material](int shift) {
    return static_cast<float>(linear_from_srgb((material >> shift & 1023u) / double{COLOUR_STEPS}));
  };
  return {channel(0), channel(10), channel(20)};
}

void DeviceScene::store_textures(const scene::RenderScene& scene) {
  addresses_.textures = store(std::span(scene.textures));
  addresses_.texels = store(std::span<const std::uint32_t>(scene.texels));
  std::vector<float> linear(1024);  // what 10 bits can hold
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = static_cast<float>(linear_from_srgb(double(i) / COLOUR_STEPS));
  addresses_.linear_of_step = store(std::span<const float>(linear));
  LargeVector<std::uint32_t> once;
  const auto order = order_triangles(device_, scene, once);
  gpu::Buffer corners(device_, order.size() * sizeof(gpu::TextureCorners));
  corners.make_first<gpu::TextureCorners>(
      order.size(), [&](std::span<gpu::TextureCorners> to, std::size_t first) {
        for (std::size_t i = 0; i < to.size(); ++i)
          to[i] = scene.triangles.texture_corners(order[first + i]);
      });
  storage_.push_back(std::move(corners));
  addresses_.texture_corners = storage_.back().address();
}

void DeviceScene::store_geometry(const scene::RenderScene& scene, scene::RenderScene* released) {
  LargeVector<std::uint32_t> once;
  storage_.push_back(upload_triangles(device_, scene, order_triangles(device_, scene, once)));
  free_memory(once);
  addresses_.triangles = storage_.back().address();
  if (released) {
    free_memory(released->triangles);
    free_memory(released->triangle_order);
    free_memory(released->texels);
  }
  addresses_.root = scene.root;
  addresses_.horizon = scene.horizon;
  addresses_.boxes_along = scene.boxes_along;
  addresses_.boxes_margin_m = scene.boxes_margin_m;
  addresses_.static_lights = static_cast<std::uint32_t>(scene.lights.size());
  addresses_.light_count = addresses_.static_lights;
  std::span<const gpu::Instance> instances = scene.instances;
  std::vector<gpu::Instance> with_triangles;
  if (device_.trace() != gpu::Trace::compute) {
    tlas_.emplace(device_, scene, addresses_.triangles);
    with_triangles = scene.instances;
    instances = with_triangles;
    for (gpu::Instance& instance : with_triangles)
      instance.root = tlas_->first_triangle(instance.root);
    addresses_.tlas = to_words(tlas_->top_level(0).address());
  }
  if (scene.traffic.trips.empty()) {
    addresses_.nodes = store(std::span(scene.nodes));
    addresses_.instances = store(instances);
  } else {
    store_traffic(scene, instances);
  }
  if (!released) return;
  free_memory(released->nodes);
  free_memory(released->instances);
}

void DeviceScene::store_traffic(const scene::RenderScene& scene,
                                std::span<const gpu::Instance> instances) {
  const scene::Traffic& traffic = scene.traffic;
  const auto trips = static_cast<std::uint32_t>(traffic.trips.size());
  gpu::TrafficBuffers& to = addresses_.traffic;
  to.vehicles = store(std::span(traffic.vehicles));
  std::vector<gpu::VehicleBody> bodies = traffic.bodies;
  if (tlas_) {
    for (gpu::VehicleBody& body : bodies) body.root = tlas_->first_triangle(body.root);
    to.body_blas = tlas_->body_blas();
    to.has_tlas = 1;
  }
  to.bodies = store(std::span<const gpu::VehicleBody>(bodies));
  to.trips = store(std::span(traffic.trips));
  to.knots = store(std::span(traffic.knots));
  to.cycle = traffic.cycle;
  to.trip_count = trips;

  to.level_count[0] = trips;
  std::uint32_t inner = 0;
  for (to.levels = 1; to.levels < 2 || to.level_count[to.levels - 1] > 1; ++to.levels) {
    if (to.levels == VEHICLE_LEVELS) throw Error("traffic", "more than 4 million trips");
    to.level_first[to.levels] = to.level_first[to.levels - 1] + to.level_count[to.levels - 1];
    to.level_count[to.levels] = (to.level_count[to.levels - 1] + 3) / 4;
    inner += to.level_count[to.levels];
  }
  to.static_root = scene.root;
  to.lower = scene.root_box.lower;
  to.upper = scene.root_box.upper;
  static_instances_ = static_cast<std::uint32_t>(instances.size());
  static_nodes_ = static_cast<std::uint32_t>(scene.nodes.size());
  slot_nodes_ = inner + 1;
  const auto store_before_slots = [&](auto values, std::size_t slot_size) {
    gpu::Buffer buffer(device_,
                       (values.size() + usual_vehicle_slots * slot_size) * sizeof(values[0]));
    if (!values.empty()) buffer.upload_first(values.data(), values.size_bytes());
    return buffer;
  };
  instances_ = store_before_slots(instances, trips);
  nodes_ = store_before_slots(std::span(scene.nodes), slot_nodes_);
  addresses_.instances = instances_.address();
  addresses_.nodes = nodes_.address();
  slot_taken_.resize(usual_vehicle_slots);
  addresses_.light_count += trips * VEHICLE_LIGHTS;
}

void DeviceScene::grow_vehicle_slots(std::uint32_t count) {
  const auto grow = [&](gpu::Buffer& buffer, std::size_t static_bytes, std::size_t slot_bytes) {
    gpu::Buffer grown(device_, static_bytes + count * slot_bytes);
    const VkBufferCopy copy{0, 0, static_bytes + slot_taken_.size() * slot_bytes};
    device_.run([&](VkCommandBuffer commands) {
      vkCmdCopyBuffer(commands, buffer.handle(), grown.handle(), 1, &copy);
    });
    buffer = std::move(grown);
    return buffer.address();
  };
  addresses_.instances = grow(instances_, static_instances_ * sizeof(gpu::Instance),
                              addresses_.traffic.trip_count * sizeof(gpu::Instance));
  addresses_.nodes =
      grow(nodes_, static_nodes_ * sizeof(gpu::BvhNode), slot_nodes_ * sizeof(gpu::BvhNode));
  slot_taken_.resize(count);
}

std::uint32_t DeviceScene::acquire_vehicle_slot() {
  const auto free = std::find(slot_taken_.begin(), slot_taken_.end(), false);
  const auto slot = static_cast<std::uint32_t>(free - slot_taken_.begin());
  if (free == slot_taken_.end()) grow_vehicle_slots(slot + usual_vehicle_slots);
  slot_taken_[slot] = true;
  return slot;
}

void DeviceScene::release_vehicle_slot(std::uint32_t slot) {
  slot_taken_[slot] = false;
}

VehicleSlot DeviceScene::vehicle_slot(std::uint32_t slot) const {
  VehicleSlot result{};
  result.first_instance = static_instances_ + slot * addresses_.traffic.trip_count;
  result.first_bvh_node = static_nodes_ + slot * slot_nodes_;
  result.root = result.first_bvh_node + slot_nodes_ - 1;
  result.instances =
      addresses_.instances + std::uint64_t{result.first_instance} * sizeof(gpu::Instance);
  result.bvh = addresses_.nodes + std::uint64_t{result.first_bvh_node} * sizeof(gpu::BvhNode);
  return result;
}

bool DeviceScene::set_time(double time_s, scene::LightFamilies on) {
  const bool changed = lights_->set_time(time_s, on);
  lights_->enter(addresses_);
  if (changed) follow_sky();
  return changed;
}

void DeviceScene::follow_sky() {
  if (sky_shares_.empty()) return;
  glm::dvec3 upward_lm(0);
  for (const scene::SkyMap::Share& share : sky_shares_)
    upward_lm += lights_->flux_now(share.light) * glm::dvec3(share.per_lumen);
  // Lights can be edited beyond all measure; a greater factor would leave nothing of the map's
  // precision.
  constexpr double greatest = 1e5;
  for (int c = 0; c < 3; ++c)
    sky_now_.factor[c] =
        sky_upward_lm_[c] > 0 ? float(std::min(upward_lm[c] / sky_upward_lm_[c], greatest)) : 1.0f;
  sky_now_.base = natural_sky_cd_m2_ * (1.0f - sky_now_.factor);
}

std::uint64_t DeviceScene::bytes() const {
  std::uint64_t total = 0;
  for (const gpu::Buffer& buffer : storage_) total += buffer.bytes();
  total += instances_.bytes() + nodes_.bytes() + lights_->bytes();
  return total + (tlas_ ? tlas_->bytes() : 0);
}

}  // namespace nightcity::render
