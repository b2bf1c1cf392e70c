// A scene's acceleration structures on the device, for rays that do not go through our own BVHs: a
// BLAS per mesh and a TLAS over the instances.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "runtime/gpu/ray_tracing.h"
#include "runtime/scene/render_scene.h"

namespace nightcity {

class SceneTlas {
 public:
  /// Builds all BLASes and a TLAS with the static instances. `triangles` is the address of the
  /// scene's triangles on the device. With traffic, every frame must call build(). Throws Error
  /// above 16 million instances.
  SceneTlas(gpu::Device& device, const RenderScene& scene, std::uint64_t triangles);

  /// Returns the index of the first triangle of the mesh whose BVH has this root.
  std::uint32_t first_triangle(std::uint32_t root) const;
  /// Records a rebuild of the TLAS.
  void build(VkCommandBuffer commands) const { tlas_.build(commands); }
  std::uint64_t address() const { return tlas_.address(); }
  /// Returns the address of the first trip's instance record among those that the TLAS is built
  /// from.
  std::uint64_t trip_instances() const { return trip_instances_; }
  /// Returns the address of a list with the BLAS addresses of the vehicle kinds.
  std::uint64_t body_blas() const { return bodies_.address(); }
  std::uint64_t bytes() const;

 private:
  struct Placed {
    std::uint32_t first_triangle;
    gpu::AccelerationStructure blas;
  };
  std::map<std::uint32_t, Placed> meshes_;  // by root
  gpu::Buffer instances_, bodies_;
  gpu::AccelerationStructure tlas_;
  std::uint64_t trip_instances_ = 0;
};

}  // namespace nightcity
