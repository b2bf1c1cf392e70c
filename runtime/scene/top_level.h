// The top of a scene's hierarchy (TLAS), and the ground around the scene.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// A hierarchy that a TLAS lies over.
struct TopPart {
  std::uint32_t root;        // not BVH_EMPTY
  std::uint32_t stack_need;  // entries that a ray may have to defer in it
  gpu::Instance instance;
  Box box;  // in the frame of the TLAS's boxes
  // It is in the scene's own frame, and its instance is among the scene's already. Others are in
  // their instance's frame.
  bool is_static = false;
};

/// Returns the matrix from the frame of an instance's mesh to that of the scene.
glm::dmat4 find_to_scene(const gpu::Instance& instance);

/// Builds the scene's TLAS over parts of it, and appends their instances. Instances that cast
/// shadows are put into the hierarchy of the static triangles that do, as far as the stack of rays
/// allows: trees stand among houses, and rays then meet them on their way through the city, in place
/// of going through another hierarchy after it. The result does not depend on the number of threads.
void add_top_level(RenderScene& out, std::vector<TopPart> parts, unsigned threads);

/// The same over the ground around the scene, whose parts are instances.
void add_horizon(RenderScene& out, const std::vector<TopPart>& parts, unsigned threads);

}  // namespace nightcity::scene
