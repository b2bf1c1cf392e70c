#include "runtime/scene/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "support/scenes.h"

namespace nightcity::test {
namespace {

std::vector<std::uint32_t> indices_of(std::span<const Light> lights) {
  std::vector<std::uint32_t> all(lights.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

TEST(LightTree, OfNoLightHasNoLevel) {
  EXPECT_EQ(scene::build_light_tree({}, {}).shape.levels, 0u);
}

// Every node's box and flux are those of the leaves below it, and its children are places 4 i to 4
// i + 3 of the level below.
TEST(LightTree, NodesSumUpWhatIsBelowThem) {
  for (const int count : {1, 2, 4, 5, 17, 1000}) {
    const std::vector<Light> lights = random_lamps(count, 50, 3);
    const scene::LightTree tree = scene::build_light_tree(lights, indices_of(lights));
    const gpu::LightTree& shape = tree.shape;
    ASSERT_EQ(shape.level_count[0], std::uint32_t(count));
    ASSERT_EQ(shape.level_count[shape.levels - 1], 1u);
    for (std::uint32_t level = 1; level < shape.levels; ++level)
      for (std::uint32_t i = 0; i < shape.level_count[level]; ++i) {
        const gpu::LightNode& node = tree.nodes[shape.level_first[level] + i];
        float flux = 0;
        for (std::uint32_t child = 4 * i; child < std::min(4 * i + 4, shape.level_count[level - 1]);
             ++child) {
          const gpu::LightNode& below = tree.nodes[shape.level_first[level - 1] + child];
          flux += below.flux_lm;
          for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(node.lower[axis], below.lower[axis]);
            EXPECT_GE(node.upper[axis], below.upper[axis]);
          }
        }
        EXPECT_EQ(node.flux_lm, flux);
      }
  }
}

TEST(LightTree, HasALeafForEachLightThatShinesAndNoOther) {
  const std::vector<Light> lights = random_lamps(40, 50, 3);
  const std::vector<std::uint32_t> lit{3, 7, 8, 21, 39};
  const scene::LightTree tree = scene::build_light_tree(lights, lit);
  ASSERT_EQ(tree.shape.level_count[0], lit.size());
  for (const std::uint32_t light : lit) {
    EXPECT_EQ(tree.nodes[tree.leaf_of_light[light]].item, light);
    EXPECT_EQ(tree.nodes[tree.leaf_of_light[light]].flux_lm, lights[light].flux_lm);
  }
}

}  // namespace
}  // namespace nightcity::test
