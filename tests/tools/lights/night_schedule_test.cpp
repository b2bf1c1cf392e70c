// Hours of light, as recipes name them and as city.lights stores them.
#include "tools/lights/night_schedule.h"

#include <gtest/gtest.h>

#include <vector>

#include "formats/night_check.h"
#include "tests/tools/lights/kept_schedules.h"
#include "tests/tools/lights/make_night.h"
#include "tools/random.h"

namespace nightcity::lights {
namespace {

TEST(ScheduleTable, EqualNightsAreStoredOnceAndKeepTheirNumbers) {
  test::KeptSchedules kept;
  const auto evening = night({{0, 300}}), both = night({{0, 300}, {720, 800}});
  EXPECT_EQ(kept.table.add(evening), 0u);
  EXPECT_EQ(kept.table.add(both), 1u);
  EXPECT_EQ(kept.table.add(evening), 0u);
  EXPECT_EQ(kept.table.size(), 2u);
  EXPECT_EQ(kept.schedules.size(), 2u);
  // 17:00, 22:00; 17:00, 22:00, 05:00 and 06:20 as seconds since noon.
  EXPECT_EQ(kept.switches, (std::vector<uint>{18000, 36000, 18000, 36000, 61200, 66000}));
}

TEST(ScheduleTable, BeyondWhatItRemembersANumberStillMeansItsNight) {
  test::KeptSchedules kept(10);
  for (int n = 0; n < 200; ++n) {
    const int on = n % 25;  // in turn, so that each is forgotten before it comes again
    const Schedule& stored = kept.schedules[kept.table.add(night({{on, on + 1}}))];
    EXPECT_EQ(stored.count, 2u);
    EXPECT_EQ(kept.switches[stored.first], night_begin_s + 60 * static_cast<uint>(on));
  }
  EXPECT_EQ(kept.table.size(), 200u);
}

TEST(ScheduleTable, FilesShineWhenTheNightDoesMinuteByMinute) {
  test::KeptSchedules kept;
  for (int n = 0; n < 300; ++n) {
    Random random{n};
    NightSchedule schedule;
    int at = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      at += random.integer(1, 90);
      schedule.on[k] = static_cast<std::uint16_t>(at);
      at += random.integer(1, 90);
      schedule.off[k] = static_cast<std::uint16_t>(at);
    }
    const std::uint32_t number = kept.table.add(schedule);
    const Schedule& stored = kept.schedules[number];
    ASSERT_FALSE(schedule_fault(stored, kept.switches)) << n;
    for (int minute = 0; minute < night_minutes; ++minute)
      for (const uint second : {0u, 59u})
        ASSERT_EQ(
            is_lit(stored, kept.switches, night_begin_s + 60 * static_cast<uint>(minute) + second),
            schedule.lit_at(minute))
            << n << " " << minute;
    EXPECT_FALSE(is_lit(stored, kept.switches, 0));       // noon
    EXPECT_FALSE(is_lit(stored, kept.switches, 86'399));  // and the second before the next noon
  }
}

TEST(NightSchedule, DarkInTheMiddleOfTheNight) {
  EXPECT_EQ(dark_between(minute_of(23, 0), minute_of(5, 0)), night({{0, 360}, {720, 840}}));
  EXPECT_EQ(dark_between(0, minute_of(5, 0)), night({{720, 840}}));
  EXPECT_TRUE(dark_between(0, night_minutes).never());
}

TEST(NightSchedule, SpansOfRecipesAreReadOrRefused) {
  const auto span = parse_night_span("23:30-04:15");
  ASSERT_TRUE(span);
  EXPECT_EQ(span->from, minute_of(23, 30));
  EXPECT_EQ(span->to, minute_of(4, 15));
  for (const char* text :
       {"", "23:30", "04:15-23:30", "12:00-14:00", "23:60-04:00", "23:30-04:15 ", "a:bb-c:dd"})
    EXPECT_FALSE(parse_night_span(text)) << text;
}

}  // namespace
}  // namespace nightcity::lights
