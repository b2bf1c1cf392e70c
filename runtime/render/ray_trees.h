// A scene's acceleration structures on the device, for rays that do not go through our own hierarchy: one a
// mesh, and one over what is placed.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "runtime/gpu/ray_tracing.h"
#include "runtime/scene/render_scene.h"

namespace nightcity {

class RayTrees {
 public:
  /// `triangles`: address of the scene's on the device. Builds what stands; where there is traffic, build()
  /// is to follow in each frame.
  RayTrees(gpu::Device& device, const RenderScene& scene, std::uint64_t triangles);

  /// Of the mesh with this root.
  std::uint32_t first_triangle(std::uint32_t root) const;
  void build(VkCommandBuffer commands) const { top_.build(commands); }
  std::uint64_t address() const { return top_.address(); }
  /// Of the first trip's record among those that the top level is built from.
  std::uint64_t trip_instances() const { return trip_instances_; }
  /// Addresses of the vehicle bodies' structures, one a kind.
  std::uint64_t body_blas() const { return bodies_.address(); }
  std::uint64_t bytes() const;

 private:
  struct Placed {
    std::uint32_t first_triangle;
    gpu::AccelerationStructure tree;
  };
  std::map<std::uint32_t, Placed> meshes_;  // by root
  gpu::Buffer instances_, bodies_;
  gpu::AccelerationStructure top_;
  std::uint64_t trip_instances_ = 0;
};

}  // namespace nightcity
