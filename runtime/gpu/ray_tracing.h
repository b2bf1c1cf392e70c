// Acceleration structures (VK_KHR_acceleration_structure) and ray tracing pipelines
// (VK_KHR_ray_tracing_pipeline), on a device whose Options::trace is not compute.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/pipeline.h"

namespace nightcity::gpu {

// DestroyedBy would not do here, because the loader exports no functions of extensions.
struct DestroyAccelerationStructure {
  const Device* device = nullptr;
  void operator()(VkAccelerationStructureKHR handle) const;
};

class AccelerationStructure {
 public:
  AccelerationStructure() = default;
  /// Builds and returns a BLAS over `count` triangles (gpu::Triangle) at `address`.
  static AccelerationStructure of_triangles(Device& device, std::uint64_t address,
                                            std::uint32_t count);
  /// Returns a TLAS over `count` records of VkAccelerationStructureInstanceKHR at `address`. It is
  /// not built yet: build() reads them.
  static AccelerationStructure of_instances(Device& device, std::uint64_t address,
                                            std::uint32_t count);

  /// Records the build, with barriers before and after.
  void build(VkCommandBuffer commands) const;
  std::uint64_t address() const { return address_; }
  std::uint64_t bytes() const { return storage_.bytes() + scratch_.bytes(); }

 private:
  AccelerationStructure(Device& device, VkAccelerationStructureTypeKHR type,
                        const VkAccelerationStructureGeometryKHR& geometry, std::uint32_t count);

  VkAccelerationStructureBuildGeometryInfoKHR build_info() const;

  Device* device_ = nullptr;
  VkAccelerationStructureTypeKHR type_{};
  VkAccelerationStructureGeometryKHR geometry_{};
  std::uint32_t count_ = 0;
  Buffer storage_, scratch_;
  std::unique_ptr<std::remove_pointer_t<VkAccelerationStructureKHR>, DestroyAccelerationStructure>
      handle_;  // lies in storage_
  std::uint64_t address_ = 0;
};

/// A ray generation shader with one miss and one closest-hit shader.
class RayPass {
 public:
  RayPass() = default;
  struct Shaders {
    std::span<const std::uint32_t> generation, miss, hit;
  };
  /// Specialization constant i of the ray generation shader takes constants[i].
  RayPass(Device& device, const Shaders& shaders, std::span<const std::uint32_t> constants,
          std::uint32_t push_bytes);

  /// Records width x height x depth invocations of the ray generation shader.
  void dispatch(VkCommandBuffer commands, const void* push, std::uint32_t width,
                std::uint32_t height = 1, std::uint32_t depth = 1) const;

 private:
  Device* device_ = nullptr;
  PipelineLayout layout_;
  Pipeline pipeline_;
  Buffer table_;            // shader binding table: generation, miss, hit
  std::uint64_t base_ = 0;  // address of the first record, aligned as the device requires
  VkDeviceSize record_bytes_ = 0;
  std::uint32_t push_bytes_ = 0;
};

}  // namespace nightcity::gpu
