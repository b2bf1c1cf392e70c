#include "runtime/render/scene_tlas.h"

#include <cstring>
#include <glm/mat4x4.hpp>

#include "formats/error.h"
#include "runtime/scene/top_level.h"

namespace nightcity::render {
namespace {

static_assert(sizeof(VkAccelerationStructureInstanceKHR) == 4 * TLAS_INSTANCE_WORDS);

VkAccelerationStructureInstanceKHR make_record(const gpu::Instance& instance, std::uint32_t index,
                                               std::uint64_t blas) {
  const glm::dmat4 to_model = scene::find_to_scene(instance);
  VkAccelerationStructureInstanceKHR record{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      record.transform.matrix[row][column] = static_cast<float>(to_model[column][row]);
  record.instanceCustomIndex = index & 0xFFFFFFu;
  record.mask = instance.mask & 0xFFu;
  record.accelerationStructureReference = blas;
  return record;
}

}  // namespace

SceneTlas::SceneTlas(gpu::Device& device, const scene::RenderScene& scene, std::uint64_t triangles)
    : device_(device) {
  const std::size_t trips = scene.traffic.trips.size(), placed = scene.instances.size() + trips;
  if (placed > 0xFFFFFFu)
    throw Error("scene", "more than 16 million instances: too many for any --trace but compute");
  for (const scene::Mesh& mesh : scene.meshes)
    meshes_.insert_or_assign(
        mesh.root,
        Placed{mesh.first_triangle,
               gpu::AccelerationStructure::of_triangles(
                   device, triangles + std::uint64_t{mesh.first_triangle} * sizeof(gpu::Triangle),
                   mesh.triangles)});

  records_.resize(placed);
  static_records_ = static_cast<std::uint32_t>(scene.instances.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const gpu::Instance& instance = scene.instances[i];
    records_[i] = make_record(instance, i, meshes_.at(instance.root).blas.address());
  }
  std::vector<std::uint64_t> bodies;
  for (const gpu::VehicleBody& body : scene.traffic.bodies) {
    const auto mesh = meshes_.find(body.root);
    bodies.push_back(mesh == meshes_.end() ? 0 : mesh->second.blas.address());
  }
  bodies_ = gpu::Buffer::of(device, std::span<const std::uint64_t>(bodies));
}

SceneTlas::TopLevel::TopLevel(gpu::Device& device,
                              std::span<const VkAccelerationStructureInstanceKHR> records,
                              std::uint32_t static_records)
    : records_(gpu::Buffer::of(device, records)),
      tlas_(gpu::AccelerationStructure::of_instances(device, records_.address(),
                                                     static_cast<std::uint32_t>(records.size()))),
      trip_instances_(records_.address() +
                      std::uint64_t{static_records} * sizeof(VkAccelerationStructureInstanceKHR)) {
  device.run([&](VkCommandBuffer commands) { tlas_.build(commands); });
}

const SceneTlas::TopLevel& SceneTlas::top_level(std::uint32_t slot) {
  return top_levels_.try_emplace(slot, device_, records_, static_records_).first->second;
}

std::uint32_t SceneTlas::first_triangle(std::uint32_t root) const {
  const auto mesh = meshes_.find(root);
  return mesh == meshes_.end() ? 0 : mesh->second.first_triangle;
}

std::uint64_t SceneTlas::bytes() const {
  std::uint64_t total = bodies_.bytes();
  for (const auto& [slot, top_level] : top_levels_) total += top_level.bytes();
  for (const auto& [root, mesh] : meshes_) total += mesh.blas.bytes();
  return total;
}

}  // namespace nightcity::render
