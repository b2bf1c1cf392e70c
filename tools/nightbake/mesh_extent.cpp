#include "tools/nightbake/mesh_extent.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <tuple>

#include "formats/finite.h"

namespace nightcity::nightbake {
namespace {

// Returns whether a copy of a box lies within bounds, whatever rounding does to its vertices.
bool lies_within(const glm::vec3& low, const glm::vec3& high, const glm::mat4& to_model,
                 const Bounds& bounds) {
  constexpr double rounding = 1e-6;
  const glm::dmat4 matrix(to_model);
  const glm::dvec3 middle = (glm::dvec3(low) + glm::dvec3(high)) / 2.0,
                   half = (glm::dvec3(high) - glm::dvec3(low)) / 2.0;
  for (int axis = 0; axis < 3; ++axis) {
    double centre = matrix[3][axis], reach = 0, size = std::abs(centre);
    for (int k = 0; k < 3; ++k) {
      centre += matrix[k][axis] * middle[k];
      reach += std::abs(matrix[k][axis]) * half[k];
      size += std::abs(matrix[k][axis]) * (std::abs(middle[k]) + half[k]);
    }
    reach += rounding * size;
    if (!(centre - reach >= bounds.min[axis] && centre + reach <= bounds.max[axis])) return false;
  }
  return true;
}

}  // namespace

MeshExtent::MeshExtent(const SceneMesh& mesh) {
  constexpr std::size_t points_a_block = 64;
  for (const ScenePrimitive& primitive : mesh.primitives)
    for (const glm::vec3& p : primitive.positions)
      if (finite(p)) points_.push_back(p);
  std::sort(points_.begin(), points_.end(), [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  for (std::size_t begin = 0; begin < points_.size(); begin += points_a_block)
    blocks_.push_back(find_block(begin, std::min(points_.size(), begin + points_a_block)));
  if (points_.empty()) return;
  const Block whole = find_block(0, points_.size());
  low_ = whole.low;
  high_ = whole.high;
}

MeshExtent::Block MeshExtent::find_block(std::size_t begin, std::size_t end) const {
  Block block{begin, end, points_[begin], points_[begin]};
  for (std::size_t n = begin; n < end; ++n) {
    block.low = glm::min(block.low, points_[n]);
    block.high = glm::max(block.high, points_[n]);
  }
  return block;
}

void MeshExtent::add_copy(const glm::mat4& to_model, Bounds& bounds) const {
  if (points_.empty() || lies_within(low_, high_, to_model, bounds)) return;
  for (const Block& block : blocks_) {
    if (lies_within(block.low, block.high, to_model, bounds)) continue;
    for (std::size_t n = block.begin; n < block.end; ++n)
      bounds.add(glm::dvec3(to_model * glm::vec4(points_[n], 1)));
  }
}

}  // namespace nightcity::nightbake
