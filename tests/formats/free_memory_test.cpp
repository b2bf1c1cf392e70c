#include "formats/free_memory.h"

#include <gtest/gtest.h>

#include <vector>

#include "formats/large_vector.h"

namespace nightcity {
namespace {

TEST(FreeMemory, LeavesAContainerWithoutAnElementOrMemory) {
  std::vector<int> small(1000);
  LargeVector<double> large(10 << 20);
  std::vector<std::vector<int>> nested(10, std::vector<int>(10));
  free_memory(small);
  free_memory(large);
  free_memory(nested);
  EXPECT_EQ(small.capacity(), 0u);
  EXPECT_EQ(large.capacity(), 0u);
  EXPECT_EQ(nested.capacity(), 0u);
}

}  // namespace
}  // namespace nightcity
