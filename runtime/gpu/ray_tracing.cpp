#include "runtime/gpu/ray_tracing.h"

#include <array>
#include <cstring>
#include <vector>

#include "runtime/gpu/vulkan_check.h"
#include "shaders/interface.h"

namespace nightcity::gpu {
namespace {

template <class Function>
Function load(const Device& device, const char* name) {
  return reinterpret_cast<Function>(vkGetDeviceProcAddr(device.handle(), name));
}

VkDeviceSize up_to(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

constexpr VkDeviceSize scratch_alignment = 256;  // no device requires more

}  // namespace

AccelerationStructure::AccelerationStructure(Device& device, VkAccelerationStructureTypeKHR type,
                                             const VkAccelerationStructureGeometryKHR& geometry,
                                             std::uint32_t count)
    : device_(&device), type_(type), geometry_(geometry), count_(count) {
  const VkAccelerationStructureBuildGeometryInfoKHR info = build_info();
  VkAccelerationStructureBuildSizesInfoKHR sizes{};
  sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
  load<PFN_vkGetAccelerationStructureBuildSizesKHR>(device,
                                                    "vkGetAccelerationStructureBuildSizesKHR")(
      device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &count_, &sizes);
  storage_ = Buffer(device, sizes.accelerationStructureSize);
  scratch_ = Buffer(device, sizes.buildScratchSize + scratch_alignment);

  VkAccelerationStructureCreateInfoKHR create{};
  create.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
  create.buffer = storage_.handle();
  create.size = sizes.accelerationStructureSize;
  create.type = type;
  VkAccelerationStructureKHR handle = VK_NULL_HANDLE;
  VK_CHECK(load<PFN_vkCreateAccelerationStructureKHR>(device, "vkCreateAccelerationStructureKHR")(
      device.handle(), &create, nullptr, &handle));
  handle_ = {handle, {&device}};
  VkAccelerationStructureDeviceAddressInfoKHR address{};
  address.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
  address.accelerationStructure = handle;
  address_ = load<PFN_vkGetAccelerationStructureDeviceAddressKHR>(
      device, "vkGetAccelerationStructureDeviceAddressKHR")(device.handle(), &address);
}

AccelerationStructure AccelerationStructure::of_triangles(Device& device, std::uint64_t address,
                                                          std::uint32_t count) {
  // A record is three corners, each followed by one word: vertices of 16 bytes without indices.
  static_assert(sizeof(Triangle) == 48);
  VkAccelerationStructureGeometryKHR geometry{};
  geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
  geometry.flags = VK_GEOMETRY_OPAQUE_BIT_KHR;
  auto& triangles = geometry.geometry.triangles;
  triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
  triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
  triangles.vertexData.deviceAddress = address;
  triangles.vertexStride = 16;
  triangles.maxVertex = 3 * count - 1;
  triangles.indexType = VK_INDEX_TYPE_NONE_KHR;
  AccelerationStructure made(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometry,
                             count);
  device.run([&](VkCommandBuffer commands) { made.build(commands); });
  made.scratch_ = {};
  return made;
}

AccelerationStructure AccelerationStructure::of_instances(Device& device, std::uint64_t address,
                                                          std::uint32_t count) {
  VkAccelerationStructureGeometryKHR geometry{};
  geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  geometry.flags = VK_GEOMETRY_OPAQUE_BIT_KHR;
  auto& instances = geometry.geometry.instances;
  instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
  instances.data.deviceAddress = address;
  return {device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, geometry, count};
}

void DestroyAccelerationStructure::operator()(VkAccelerationStructureKHR handle) const {
  load<PFN_vkDestroyAccelerationStructureKHR>(*device, "vkDestroyAccelerationStructureKHR")(
      device->handle(), handle, nullptr);
}

VkAccelerationStructureBuildGeometryInfoKHR AccelerationStructure::build_info() const {
  VkAccelerationStructureBuildGeometryInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
  info.type = type_;
  info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = 1;
  info.pGeometries = &geometry_;
  return info;
}

void AccelerationStructure::build(VkCommandBuffer commands) const {
  VkAccelerationStructureBuildGeometryInfoKHR info = build_info();
  info.dstAccelerationStructure = handle_.get();
  info.scratchData.deviceAddress = up_to(scratch_.address(), scratch_alignment);
  VkAccelerationStructureBuildRangeInfoKHR range{};
  range.primitiveCount = count_;
  const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
  full_barrier(commands);
  load<PFN_vkCmdBuildAccelerationStructuresKHR>(*device_, "vkCmdBuildAccelerationStructuresKHR")(
      commands, 1, &info, &ranges);
  full_barrier(commands);
}

RayPass::RayPass(Device& device, const Shaders& shaders, std::span<const std::uint32_t> constants,
                 std::uint32_t push_bytes)
    : device_(&device),
      layout_(make_layout(device, VK_SHADER_STAGE_RAYGEN_BIT_KHR, push_bytes)),
      push_bytes_(push_bytes) {
  const Specialization specialization(constants);
  std::array<VkPipelineShaderStageCreateInfo, 3> stages{};
  std::array<VkRayTracingShaderGroupCreateInfoKHR, 3> groups{};
  const std::array<VkShaderStageFlagBits, 3> kinds{VK_SHADER_STAGE_RAYGEN_BIT_KHR,
                                                   VK_SHADER_STAGE_MISS_BIT_KHR,
                                                   VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR};
  const std::array<ShaderModule, 3> modules{make_shader(device, shaders.generation),
                                            make_shader(device, shaders.miss),
                                            make_shader(device, shaders.hit)};
  for (std::uint32_t i = 0; i < 3; ++i) {
    stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stages[i].stage = kinds[i];
    stages[i].module = modules[i].get();
    stages[i].pName = "main";
    groups[i].sType = VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR;
    groups[i].type = i < 2 ? VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR
                           : VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR;
    groups[i].generalShader = i < 2 ? i : VK_SHADER_UNUSED_KHR;
    groups[i].closestHitShader = i < 2 ? VK_SHADER_UNUSED_KHR : i;
    groups[i].anyHitShader = groups[i].intersectionShader = VK_SHADER_UNUSED_KHR;
  }
  stages[0].pSpecializationInfo = specialization.info();
  VkRayTracingPipelineCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR;
  info.stageCount = 3;
  info.pStages = stages.data();
  info.groupCount = 3;
  info.pGroups = groups.data();
  info.maxPipelineRayRecursionDepth = 1;
  info.layout = layout_.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  VK_CHECK(load<PFN_vkCreateRayTracingPipelinesKHR>(device, "vkCreateRayTracingPipelinesKHR")(
      device.handle(), VK_NULL_HANDLE, device.pipelines(), 1, &info, nullptr, &pipeline));
  pipeline_ = {pipeline, {device.handle()}};

  VkPhysicalDeviceRayTracingPipelinePropertiesKHR rays{};
  rays.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &rays;
  vkGetPhysicalDeviceProperties2(device.physical(), &properties);
  const std::size_t handle_bytes = rays.shaderGroupHandleSize;
  record_bytes_ =
      up_to(up_to(handle_bytes, rays.shaderGroupHandleAlignment), rays.shaderGroupBaseAlignment);
  std::vector<std::uint8_t> handles(3 * handle_bytes);
  VK_CHECK(load<PFN_vkGetRayTracingShaderGroupHandlesKHR>(
      device, "vkGetRayTracingShaderGroupHandlesKHR")(device.handle(), pipeline, 0, 3,
                                                      handles.size(), handles.data()));
  std::vector<std::uint8_t> table(3 * record_bytes_);
  for (std::size_t i = 0; i < 3; ++i)
    std::memcpy(table.data() + i * record_bytes_, handles.data() + i * handle_bytes, handle_bytes);
  // Buffers are aligned as a storage buffer requires; the table may require more.
  table_ = Buffer(device, table.size() + rays.shaderGroupBaseAlignment);
  table_.upload(table.data(), table.size(),
                up_to(table_.address(), rays.shaderGroupBaseAlignment) - table_.address());
  base_ = up_to(table_.address(), rays.shaderGroupBaseAlignment);
}

void RayPass::dispatch(VkCommandBuffer commands, const void* push, std::uint32_t width,
                       std::uint32_t height, std::uint32_t depth) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline_.get());
  vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_RAYGEN_BIT_KHR, 0, push_bytes_, push);
  const auto record = [&](VkDeviceSize i) {
    return VkStridedDeviceAddressRegionKHR{base_ + i * record_bytes_, record_bytes_, record_bytes_};
  };
  const VkStridedDeviceAddressRegionKHR generation = record(0), miss = record(1), hit = record(2),
                                        none{};
  load<PFN_vkCmdTraceRaysKHR>(*device_, "vkCmdTraceRaysKHR")(commands, &generation, &miss, &hit,
                                                             &none, width, height, depth);
}

}  // namespace nightcity::gpu
