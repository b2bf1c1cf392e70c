#include "formats/schedule.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "formats/light_file.h"

namespace nightcity {
namespace {

TEST(Schedule, TogglesAtEachOfItsTimes) {
  // The first time belongs to another schedule.
  const std::vector<std::uint32_t> switches{7, 3600, 7200, 80'000};
  const Schedule schedule{1, 3};
  EXPECT_FALSE(is_lit(schedule, switches, 0));
  EXPECT_FALSE(is_lit(schedule, switches, 3599.9));
  EXPECT_TRUE(is_lit(schedule, switches, 3600));
  EXPECT_TRUE(is_lit(schedule, switches, 7199.9));
  EXPECT_FALSE(is_lit(schedule, switches, 7200));
  EXPECT_TRUE(is_lit(schedule, switches, 86'399));
  EXPECT_FALSE(is_lit(schedule, switches, 86'400)) << "the next noon";
  EXPECT_TRUE(is_lit(schedule, switches, -86'400 + 5000)) << "days repeat";
  EXPECT_FALSE(is_lit({0, 0}, switches, 40'000)) << "never switched on";
}

TEST(Schedule, FamiliesAndSourcesHaveNames) {
  for (std::size_t n = 0; n < light_family_count; ++n)
    EXPECT_EQ(std::string_view(name_of(static_cast<LightFamily>(n))) == "other",
              n + 1 == light_family_count);
  EXPECT_STREQ(name_of(static_cast<LightFamily>(200)), "other");
  EXPECT_STREQ(name_of(ValueSource::rule), "rule");
  EXPECT_STREQ(name_of(static_cast<ValueSource>(200)), "unknown");
}

}  // namespace
}  // namespace nightcity
