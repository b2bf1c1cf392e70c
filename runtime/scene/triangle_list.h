// The triangles of a scene. Most need no memory of their own, because they are read from the mapped
// scene file when they are asked for.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "formats/hierarchy/static_geometry.h"
#include "formats/hierarchy/triangle_pieces.h"
#include "formats/large_vector.h"
#include "formats/mapped_primitive.h"
#include "formats/scene_bytes.h"
#include "runtime/scene/vertex_placing.h"
#include "shaders/bvh_types.h"
#include "shaders/scene_types.h"

namespace nightcity::scene {

/// The texture coordinates of a triangle that has none.
constexpr gpu::TextureCorners without_texture{glm::vec2(std::numeric_limits<float>::quiet_NaN()),
                                              glm::vec2(0), glm::vec2(0)};

class TriangleList {
 public:
  class Iterator;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// `i` < size().
  gpu::Triangle operator[](std::size_t i) const {
    if (blocks_.empty()) return stored_[i];
    const Block& at = block_of(i);
    return at.mapped ? at.make(i - at.first) : stored_[at.stored + i - at.first];
  }
  Iterator begin() const;
  Iterator end() const;
  /// Measures the boxes of these triangles in a frame, without its margin: `to` has as many. `all`
  /// grows by the triangles in their own frame. Returns whether all that are mapped are shown: the
  /// others were looked at before they were stored.
  bool measure(std::span<const std::uint32_t> numbers, const hierarchy::BoxFrame& frame,
               std::span<hierarchy::Bounds> to, hierarchy::Bounds& all) const;
  /// Copies these triangles, of which `to` has as many. It is faster than one by one, where they
  /// lie anywhere.
  void gather(std::span<const std::uint32_t> numbers, std::span<gpu::Triangle> to) const;
  /// Copies their corners alone.
  void gather(std::span<const std::uint32_t> numbers, std::span<hierarchy::Corners> to) const;
  /// Returns whether some triangle has texture coordinates.
  bool has_texture_corners() const { return !corners_.empty(); }
  /// Returns the texture coordinates of a triangle, without_texture where it has none.
  gpu::TextureCorners texture_corners(std::size_t i) const;
  /// Copies the corners of the triangles from `first` on.
  void copy_corners(std::size_t first, std::span<hierarchy::Corners> to) const;

  /// Makes room for so many triangles that are stored. Room that is not used takes no memory.
  void reserve(std::size_t count) { stored_.reserve(count); }
  void push_back(const gpu::Triangle& triangle) { append(std::span(&triangle, 1)); }
  /// `corners`: texture coordinates of each, or none.
  void append(std::span<const gpu::Triangle> triangles,
              std::span<const gpu::TextureCorners> corners = {});
  /// Appends the triangles of a primitive, which lie in files that keep() is given.
  /// `to_scene` leads from its frame to that of the scene. `light` and `feature` go before those of
  /// its vertices, unless they are NO_HIT.
  void append(std::shared_ptr<const MappedPrimitive> primitive, const glm::dmat4& to_scene,
              std::uint32_t light = NO_HIT, std::uint32_t feature = NO_HIT);

  /// Holds the files that mapped primitives lie in as long as the list or a copy of it lives.
  void keep(std::shared_ptr<const SceneBytes> files) { files_ = std::move(files); }
  /// Gives the memory of these files' pages back to the system, as far as they were read.
  void release_pages() const {
    if (files_) files_->release_pages();
  }

  /// Returns those that are stored, to be changed: all, where nothing was read from a file.
  std::span<gpu::Triangle> stored() { return stored_; }
  /// Returns whether `is` holds for the material of a triangle.
  template <class Is>
  bool any_material(Is is) const {
    return std::any_of(blocks_.begin(), blocks_.end(),
                       [&](const Block& b) { return b.mapped && is(b.mapped->material); }) ||
           std::any_of(stored_.begin(), stored_.end(),
                       [&](const gpu::Triangle& triangle) { return is(triangle.material); });
  }

 private:
  using Vertices = std::array<std::uint32_t, 3>;
  static glm::vec3 to_vec3(hierarchy::Float4 p) { return {p[0], p[1], p[2]}; }
  static hierarchy::Corners corners_of(const gpu::Triangle& t) {
    return {hierarchy::to_float4(t.v0), hierarchy::to_float4(t.v1), hierarchy::to_float4(t.v2)};
  }
  // Consecutive triangles, from `first` to before `end`. A scene may have a hundred thousand.
  struct Block {
    std::uint32_t first, end;
    std::uint32_t stored = 0;                        // the first one's place, where they are stored
    std::uint32_t light = NO_HIT, feature = NO_HIT;  // of the whole block
    std::shared_ptr<const MappedPrimitive> mapped{};  // null: they are stored
    VertexPlacing placing{};

    // Returns triangle `i` of a mapped block.
    gpu::Triangle make(std::size_t i) const { return make(mapped->corners(i)); }
    hierarchy::Corners corners(std::size_t i) const { return corners(mapped->corners(i)); }
    // The same by its vertices.
    gpu::Triangle make(const Vertices& at) const {
      return {to_vec3(place(at[0])), mapped->material,
              to_vec3(place(at[1])), feature != NO_HIT ? feature : mapped->feature(at[0]),
              to_vec3(place(at[2])), light != NO_HIT ? light : mapped->light(at[0])};
    }
    hierarchy::Corners corners(const Vertices& at) const {
      return {place(at[0]), place(at[1]), place(at[2])};
    }
    hierarchy::Float4 place(std::uint32_t vertex) const { return placing.place(*mapped, vertex); }
  };
  static constexpr std::size_t indexed = 256;  // triangles for each entry of block_at_

  void append(Block block);
  // Notes where triangles lie that the last block has been given.
  void index_blocks();
  // There must be blocks.
  const Block& block_of(std::size_t i) const {
    std::size_t block = block_at_[i / indexed];
    while (i >= ends_[block]) ++block;
    return blocks_[block];
  }
  template <class Fetch, class Stored, class Mapped>
  void visit(std::span<const std::uint32_t> numbers, Fetch fetch, Stored stored,
             Mapped mapped) const;

  LargeVector<gpu::Triangle> stored_;
  LargeVector<gpu::TextureCorners> corners_;  // of the first of these; the others have none
  std::vector<Block> blocks_;                 // none: all are stored
  std::vector<std::size_t> ends_;             // of blocks_, so that a search reads little memory
  std::vector<std::uint32_t> block_at_;       // of triangle i * indexed
  std::size_t size_ = 0;
  std::shared_ptr<const SceneBytes> files_;
};

class TriangleList::Iterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = gpu::Triangle;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = gpu::Triangle;

  Iterator(const TriangleList& list, std::size_t at) : list_(&list), at_(at) {}
  gpu::Triangle operator*() const { return (*list_)[at_]; }
  Iterator& operator++() {
    ++at_;
    return *this;
  }
  Iterator operator++(int) { return {*list_, at_++}; }
  friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

 private:
  const TriangleList* list_;
  std::size_t at_;
};

inline TriangleList::Iterator TriangleList::begin() const {
  return {*this, 0};
}
inline TriangleList::Iterator TriangleList::end() const {
  return {*this, size_};
}

}  // namespace nightcity::scene
