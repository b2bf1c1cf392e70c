#include "runtime/scene/triangle_list.h"

#include <algorithm>

namespace nightcity::scene {

void TriangleList::copy_corners(std::size_t first, std::span<hierarchy::Corners> to) const {
  if (to.empty()) return;
  if (blocks_.empty()) {
    std::transform(stored_.begin() + static_cast<std::ptrdiff_t>(first),
                   stored_.begin() + static_cast<std::ptrdiff_t>(first + to.size()), to.begin(),
                   corners_of);
    return;
  }
  std::size_t number = block_at_[first / indexed], done = 0;
  while (done < to.size()) {
    const Block& block = blocks_[number++];
    for (std::size_t i = first + done; i < block.end && done < to.size(); ++i)
      to[done++] = block.is_mapped ? block.corners(i - block.first)
                                   : corners_of(stored_[block.stored + i - block.first]);
  }
}

void TriangleList::measure(std::span<const std::uint32_t> numbers,
                           std::span<hierarchy::Bounds> to) const {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (blocks_.empty()) {
      to[i] = corners_of(stored_[numbers[i]]).bounds();
      continue;
    }
    const Block& block = block_of(numbers[i]);
    to[i] = (block.is_mapped ? block.corners(numbers[i] - block.first)
                             : corners_of(stored_[block.stored + numbers[i] - block.first]))
                .bounds();
  }
}

gpu::TextureCorners TriangleList::texture_corners(std::size_t i) const {
  if (!blocks_.empty()) {
    const Block& block = block_of(i);
    if (block.is_mapped) return without_texture;
    i = block.stored + i - block.first;
  }
  return i < corners_.size() ? corners_[i] : without_texture;
}

void TriangleList::append(std::span<const gpu::Triangle> triangles,
                          std::span<const gpu::TextureCorners> corners) {
  if (triangles.empty()) return;
  if (!corners.empty()) {
    corners_.resize(stored_.size(), without_texture);
    corners_.insert(corners_.end(), corners.begin(), corners.end());
  }
  if (!blocks_.empty()) {
    if (blocks_.back().is_mapped)
      blocks_.push_back({size_, size_ + triangles.size(), false, false, stored_.size(), {}, {}});
    else
      blocks_.back().end += triangles.size();
  }
  stored_.insert(stored_.end(), triangles.begin(), triangles.end());
  size_ += triangles.size();
  while (!blocks_.empty() && block_at_.size() * indexed < size_)
    block_at_.push_back(static_cast<std::uint32_t>(blocks_.size() - 1));
}

void TriangleList::append(const MappedPrimitive& primitive, const glm::dmat4& to_scene) {
  if (blocks_.empty() && size_ > 0) {
    blocks_.push_back({0, size_, false, false, 0, {}, {}});
    block_at_.resize((size_ + indexed - 1) / indexed);
  }
  glm::dmat4 moved(1.0);
  moved[3] = to_scene[3];
  blocks_.push_back(
      {size_, size_ + primitive.triangles, true, moved == to_scene, 0, primitive, to_scene});
  size_ += primitive.triangles;
  while (block_at_.size() * indexed < size_)
    block_at_.push_back(static_cast<std::uint32_t>(blocks_.size() - 1));
}

}  // namespace nightcity::scene
