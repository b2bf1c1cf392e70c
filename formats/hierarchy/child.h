// The children of nodes as numbers: those of the shaders' nodes (shaders/bvh_types.h), which this
// library does not know.
#pragma once

#include <cstdint>

namespace nightcity::hierarchy {

// A child is the index of a node, or a leaf: leaf_bit | (entries - 1) << leaf_count_shift | first.
constexpr std::uint32_t no_child = 0xFFFFFFFFu, leaf_bit = 0x80000000u;
constexpr int leaf_count_shift = 27;
constexpr std::uint32_t leaf_first_mask = (1u << leaf_count_shift) - 1;

constexpr bool is_leaf(std::uint32_t child) {
  return (child & leaf_bit) != 0;
}
/// `count`: 1 to 16.
constexpr std::uint32_t make_leaf(std::uint32_t first, std::uint32_t count) {
  return leaf_bit | ((count - 1) << leaf_count_shift) | first;
}
constexpr std::uint32_t first_of_leaf(std::uint32_t leaf) {
  return leaf & leaf_first_mask;
}
constexpr std::uint32_t size_of_leaf(std::uint32_t leaf) {
  return ((leaf & ~leaf_bit) >> leaf_count_shift) + 1;
}

}  // namespace nightcity::hierarchy
