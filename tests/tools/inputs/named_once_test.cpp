#include "tools/inputs/named_once.h"

#include <gtest/gtest.h>

namespace nightcity::inputs {
namespace {

using Paths = std::vector<std::filesystem::path>;

TEST(NamedOnce, TakesEachFileOnceInTheOrderOfTheMentionThatIsKept) {
  const Paths named{"b", "a", "x/../b", "c/", "c", "a"};
  const NamedOnce first = name_once(named);
  EXPECT_EQ(first.files, (Paths{"b", "a", "c/"}));
  EXPECT_EQ(first.repeats, 3u);
  EXPECT_EQ(first.first_repeat, "x/../b");
  EXPECT_EQ(name_once(named, Mention::last).files, (Paths{"x/../b", "c", "a"}));
}

TEST(NamedOnce, LeavesFilesThatAreNamedOnce) {
  const NamedOnce once = name_once({"b", "a", "B"});
  EXPECT_EQ(once.files, (Paths{"b", "a", "B"}));
  EXPECT_EQ(once.repeats, 0u);
  EXPECT_TRUE(once.first_repeat.empty());
}

}  // namespace
}  // namespace nightcity::inputs
