#include "runtime/scene/triangle_list.h"

#include <algorithm>

namespace nightcity::scene {
namespace {

// A scene has fewer triangles than that (check_triangle_count).
std::uint32_t to_number(std::size_t triangle) {
  return static_cast<std::uint32_t>(triangle);
}

}  // namespace

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
      to[done++] = block.mapped ? block.corners(i - block.first)
                                : corners_of(stored_[block.stored + i - block.first]);
  }
}

// Calls use(i, triangle) for each of these triangles, in their order: `stored` with a triangle, or
// `mapped` with its block and vertices. They lie anywhere in the file, so the memory of some is
// asked for before the first of them is used: their indices, then their vertices. `fetch` asks for
// more of a block's vertex.
template <class Fetch, class Stored, class Mapped>
void TriangleList::visit(std::span<const std::uint32_t> numbers, Fetch fetch, Stored stored,
                         Mapped mapped) const {
  constexpr std::size_t at_once = 64;
  struct Found {
    const Block* block;  // null: it is stored
    Vertices vertices;
    std::size_t place;
  };
  std::array<Found, at_once> found;
  const Block* block = nullptr;
  for (std::size_t begin = 0; begin < numbers.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, numbers.size() - begin);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t number = numbers[begin + k];
      Found& f = found[k];
      f.block = nullptr;
      f.place = number;
      if (!blocks_.empty()) {
        if (!block || number < block->first || number >= block->end) block = &block_of(number);
        f.place = block->stored + number - block->first;
        if (block->mapped) f.block = block;
      }
      if (f.block) {
        f.place = number - block->first;
        __builtin_prefetch(block->mapped->index_place(3 * f.place));
      } else {
        __builtin_prefetch(&stored_[f.place]);
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      Found& f = found[k];
      if (!f.block) continue;
      const MappedPrimitive& primitive = *f.block->mapped;
      f.vertices = primitive.corners(f.place);
      for (const std::uint32_t vertex : f.vertices)
        __builtin_prefetch(primitive.position_place(vertex));
      fetch(primitive, f.vertices[0]);
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (found[k].block)
        mapped(begin + k, *found[k].block, found[k].vertices);
      else
        stored(begin + k, stored_[found[k].place]);
    }
  }
}

bool TriangleList::measure(std::span<const std::uint32_t> numbers, const hierarchy::BoxFrame& frame,
                           std::span<hierarchy::Bounds> to, hierarchy::Bounds& all) const {
  bool all_shown = true;
  const auto take = [&](std::size_t i, const hierarchy::Corners& corners) {
    to[i] = frame.bounds_of(corners);
    all.grow(frame.is_turned() ? corners.bounds() : to[i]);
  };
  visit(
      numbers, [](const MappedPrimitive&, std::uint32_t) {},
      [&](std::size_t i, const gpu::Triangle& triangle) { take(i, corners_of(triangle)); },
      [&](std::size_t i, const Block& block, const Vertices& vertices) {
        const hierarchy::Corners corners = block.corners(vertices);
        take(i, corners);
        all_shown &=
            block.mapped->has_vertices(numbers[i] - block.first) && hierarchy::is_shown(corners);
      });
  return all_shown;
}

void TriangleList::gather(std::span<const std::uint32_t> numbers,
                          std::span<gpu::Triangle> to) const {
  visit(
      numbers,
      [](const MappedPrimitive& primitive, std::uint32_t vertex) {
        for (const MappedPrimitive::Array& ids : {primitive.features, primitive.lights})
          if (ids.first) __builtin_prefetch(ids.first + vertex * ids.stride);
      },
      [&](std::size_t i, const gpu::Triangle& triangle) { to[i] = triangle; },
      [&](std::size_t i, const Block& block, const Vertices& vertices) {
        to[i] = block.make(vertices);
      });
}

void TriangleList::gather(std::span<const std::uint32_t> numbers,
                          std::span<hierarchy::Corners> to) const {
  visit(
      numbers, [](const MappedPrimitive&, std::uint32_t) {},
      [&](std::size_t i, const gpu::Triangle& triangle) { to[i] = corners_of(triangle); },
      [&](std::size_t i, const Block& block, const Vertices& vertices) {
        to[i] = block.corners(vertices);
      });
}

gpu::TextureCorners TriangleList::texture_corners(std::size_t i) const {
  if (!blocks_.empty()) {
    const Block& block = block_of(i);
    if (block.mapped) return without_texture;
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
    if (blocks_.back().mapped) {
      append(
          Block{to_number(size_), to_number(size_ + triangles.size()), to_number(stored_.size())});
    } else {
      blocks_.back().end += to_number(triangles.size());
      ends_.back() = blocks_.back().end;
      index_blocks();
    }
  }
  stored_.insert(stored_.end(), triangles.begin(), triangles.end());
  size_ += triangles.size();
}

void TriangleList::append(std::shared_ptr<const MappedPrimitive> primitive,
                          const glm::dmat4& to_scene, std::uint32_t light, std::uint32_t feature) {
  if (blocks_.empty() && size_ > 0) append(Block{0, to_number(size_)});
  const std::size_t end = size_ + primitive->triangles;
  append(Block{to_number(size_), to_number(end), 0, light, feature, std::move(primitive),
               VertexPlacing(to_scene)});
  size_ = end;
}

void TriangleList::append(Block block) {
  ends_.push_back(block.end);
  blocks_.push_back(std::move(block));
  index_blocks();
}

void TriangleList::index_blocks() {
  while (block_at_.size() * indexed < ends_.back())
    block_at_.push_back(static_cast<std::uint32_t>(blocks_.size() - 1));
}

}  // namespace nightcity::scene
