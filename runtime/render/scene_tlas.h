// A scene's acceleration structures on the device, for rays that do not go through our own BVHs: a
// BLAS per mesh and a TLAS over the instances.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "runtime/gpu/ray_tracing.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::render {

/// Returns an address as shaders take it, low word first.
inline glm::uvec2 to_words(std::uint64_t address) {
  return {static_cast<std::uint32_t>(address), static_cast<std::uint32_t>(address >> 32)};
}

class SceneTlas {
 public:
  /// Builds all BLASes. `triangles` is the address of the scene's triangles on the device. With
  /// traffic, every frame must build its TopLevel. Throws Error above 16 million instances.
  SceneTlas(gpu::Device& device, const scene::RenderScene& scene, std::uint64_t triangles);

  /// Returns the index of the first triangle of the mesh whose BVH has this root.
  std::uint32_t first_triangle(std::uint32_t root) const;
  /// A TLAS over all instances, and the records that it is built from.
  class TopLevel {
   public:
    TopLevel(gpu::Device& device, std::span<const VkAccelerationStructureInstanceKHR> records,
             std::uint32_t static_records);
    /// Records a rebuild.
    void build(VkCommandBuffer commands) const { tlas_.build(commands); }
    std::uint64_t address() const { return tlas_.address(); }
    /// Returns the address of the first trip's record, which the vehicles' passes fill.
    std::uint64_t trip_instances() const { return trip_instances_; }
    std::uint64_t bytes() const { return records_.bytes() + tlas_.bytes(); }

   private:
    gpu::Buffer records_;
    gpu::AccelerationStructure tlas_;
    std::uint64_t trip_instances_;
  };
  /// Returns the TLAS of a vehicle slot (0 without traffic), which the first call makes.
  const TopLevel& top_level(std::uint32_t slot);
  /// Returns the address of a list with the BLAS addresses of the vehicle kinds.
  std::uint64_t body_blas() const { return bodies_.address(); }
  std::uint64_t bytes() const;

 private:
  struct Placed {
    std::uint32_t first_triangle;
    gpu::AccelerationStructure blas;
  };
  std::map<std::uint32_t, Placed> meshes_;  // by root
  gpu::Device& device_;
  // The static instances, then the trips with mask 0, which no ray hits.
  std::vector<VkAccelerationStructureInstanceKHR> records_;
  std::uint32_t static_records_ = 0;
  gpu::Buffer bodies_;
  std::map<std::uint32_t, TopLevel> top_levels_;  // by vehicle slot
};

}  // namespace nightcity::render
