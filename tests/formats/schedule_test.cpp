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

TEST(Schedule, ASteadySpanLiesBetweenTheSwitchesRoundATime) {
  const std::vector<std::uint32_t> switches{7, 3600, 7200, 80'000, 5000, 20'000};
  const std::vector<Schedule> schedules{{1, 3}, {0, 0}, {4, 2}};
  const auto expect_span = [&](double time_s, double first_s, double end_s) {
    const TimeSpan span = find_steady_span(schedules, switches, time_s);
    EXPECT_EQ(span.first_s, first_s) << time_s;
    EXPECT_EQ(span.end_s, end_s) << time_s;
    EXPECT_TRUE(span.has(time_s)) << time_s;
    EXPECT_FALSE(span.has(end_s)) << time_s;
  };
  expect_span(0, 0, 3600);
  expect_span(3599.9, 0, 3600);
  expect_span(3600, 3600, 5000);
  expect_span(6000, 5000, 7200);
  expect_span(79'999, 20'000, 80'000);
  expect_span(80'000, 80'000, 86'400);
  expect_span(86'400 + 6000, 86'400 + 5000, 86'400 + 7200);
  expect_span(-1, -6400, 0);
  const TimeSpan always = find_steady_span({}, switches, 90'000);
  EXPECT_EQ(always.first_s, 86'400);
  EXPECT_EQ(always.end_s, 172'800);
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
