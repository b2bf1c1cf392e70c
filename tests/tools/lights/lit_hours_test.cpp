// Hours of light, as people write them.
#include "tools/lights/lit_hours.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/tools/lights/make_night.h"
#include "tools/lights/lamp_tags.h"

namespace nightcity::lights {
namespace {

TEST(NightSchedule, LitHoursAsPeopleWriteThem) {
  const std::pair<const char*, NightSchedule> known[] = {
      {"sunset-23:00", night({{0, 360}})},
      {"Sunset - 23:00", night({{0, 360}})},
      {"05:00-sunrise", night({{720, 840}})},
      {"dusk-dawn", night({{0, 840}})},
      {"24/7", night({{0, 840}})},
      {"00:00-24:00", night({{0, 840}})},
      {"18:00\xe2\x80\x93"
       "23:00",
       night({{60, 360}})},
      {"16:00-00:30;05:00-sunrise", night({{0, 450}, {720, 840}})},
      {"Mo-Su 17:00-22:00, 06:00-07:00", night({{0, 300}, {780, 840}})},
      {"22:00-24:00", night({{300, 420}})},
      {"16:00-08:00", night({{0, 840}})},
      {"06:00-08:00", night({{780, 840}})},
      {"18:00-26:00", night({{60, 540}})},
      {"(sunset+01:00)-23:00", night({{60, 360}})},
      {"(sunset-00:30)-(sunrise+00:30)", night({{0, 840}})},
      {"(sunset+00:15) - 23:00, (dawn-01:30)-sunrise", night({{15, 360}, {750, 840}})},
  };
  for (const auto& [text, schedule] : known) {
    EXPECT_EQ(parse_lit_hours(text), schedule) << text;
  }
  for (const char* text :
       {"", "yes", "sometimes", "23:00", "23:00-", "18", "20:00-22:00;21:00-23:00", "18:00-49:00",
        "(sunset)-23:00", "(20:00+01:00)-23:00", "(sunset+)-23:00", "(sunset+01:00", "()-23:00",
        "("})
    EXPECT_FALSE(parse_lit_hours(text)) << text;
}

TEST(NightSchedule, OfHoursThatDifferByTheDayThoseOfAWednesdayHold) {
  const std::pair<const char*, NightSchedule> known[] = {
      {"Mo-Fr 17:00-23:00", night({{0, 360}})},
      {"Mo-Fr sunset-23:00; Mo-Fr 05:00-sunrise", night({{0, 360}, {720, 840}})},
      {"Mo-Fr 17:00-22:00; Sa-Su 17:00-23:30", night({{0, 300}})},
      {"Sa,Su 17:00-23:30; Mo-Fr 17:00-22:00", night({{0, 300}})},
      {"Mo-Th,Su 17:00-22:00; Fr,Sa 17:00-24:00", night({{0, 300}})},
      {"Mo, We 17:00-22:00, Sa 16:30-20:00", night({{0, 300}})},
      {"Fr-Mo 17:00-23:00, We 18:00-20:00", night({{60, 180}})},
      {"Sa-We 17:00-23:00; PH off", night({{0, 360}})},
      {"Mo-Su 17:00-23:00; We 17:00-22:00", night({{0, 300}})},
      {"17:00-23:00; We 17:00-22:00", night({{0, 300}})},
      {"Mo-Fr 06:00-08:00,16:00-22:00", night({{0, 300}, {780, 840}})},
      {"06:00-08:00,16:00-22:00", night({{0, 300}, {780, 840}})},
  };
  for (const auto& [text, schedule] : known) {
    EXPECT_EQ(parse_lit_hours(text), schedule) << text;
  }
  for (const char* text : {"We[1 17:00-22:00", "Moo-Fr", "Mo-Fr 20:00-22:00;We[0]"})
    EXPECT_FALSE(parse_lit_hours(text)) << text;
}

TEST(NightSchedule, DaysWithoutHoursAreWholeDays) {
  const NightSchedule all = dark_between(night_minutes, night_minutes);
  for (const char* text : {"Mo-Fr", "Mo-Fr;", "PH off", "Oct-Mar", "Dec", "Apr-Sep off",
                           "week 40-53", "Mo-Fr 20:00-22:00;We,Th"}) {
    EXPECT_EQ(parse_lit_hours(text), all) << text;
  }
  for (const char* text :
       {"Sa,Su", "PH", "Apr-Sep", "Dec off", "closed", "week 1-26", "24/7 off"}) {
    const auto hours = parse_lit_hours(text);
    ASSERT_TRUE(hours) << text;
    EXPECT_TRUE(hours->never()) << text;
  }
}

TEST(NightSchedule, WordsRoundHoursAreNoHours) {
  const NightSchedule evening{{minute_of(17, 0)}, {minute_of(22, 0)}};
  for (const char* text :
       {"Monday-Friday 17:00-22:00", "Mon-Fri 17:00-22:00", "Montag-Freitag 17:00-22:00",
        "Di-Do 17:00-22:00", "daily 17:00-22:00", "t\xc3\xa4glich 17:00 bis 22:00 Uhr",
        "5pm to 10pm", "17:00-22:00 \"on demand\"", "17:00-22:00 || \"on demand\"",
        "17:00-22:00 || unknown", "sunset/22:00", "week 40-53 17:00-22:00",
        "week 1-13,40-53 17:00-22:00"}) {
    EXPECT_EQ(parse_lit_hours(text), evening) << text;
  }
  EXPECT_TRUE(parse_lit_hours("week 1-10 17:00-22:00")->never());
  EXPECT_FALSE(parse_lit_hours("week 1-10 17:00-22:00", Half::south)->lit_at(minute_of(18, 0)));
  EXPECT_TRUE(parse_lit_hours("week 20-30 17:00-22:00", Half::south)->lit_at(minute_of(18, 0)));
  for (const char* text : {"week 1-53/2 17:00-22:00", "week 17:00-22:00", "week", "\"17:00-22:00\"",
                           "17:00-22:00 \"", "|| 17:00-22:00"})
    EXPECT_FALSE(parse_lit_hours(text)) << text;
  EXPECT_FALSE(parse_lit_hours(std::string(2000, '"'))) << "no remark is as long";
}

TEST(NightSchedule, HoursOfOtherTimesAreReadAndDark) {
  for (const char* text :
       {"08:00-16:00", "Sa 17:00-22:00", "Mo-Fr 17:00-22:00; We off", "17:00-07:00; We off",
        "Jun-Aug 20:00-23:00", "Dec 24-26 16:00-24:00", "We 05:00-06:00", "24/7 off"}) {
    const auto hours = parse_lit_hours(text);
    ASSERT_TRUE(hours) << text;
    EXPECT_TRUE(hours->never()) << text;
  }
}

// A night is a Wednesday's evening of December and the morning of the Thursday behind it.
TEST(NightSchedule, HoursBySeasonOffOpenEndedAndOnClocksOfTwelveHours) {
  const std::pair<const char*, NightSchedule> known[] = {
      {"17:00+", night({{0, 840}})},
      {"20:30+", night({{210, 840}})},
      {"6pm-11pm", night({{60, 360}})},
      {"6:30 pm - 12 am", night({{90, 420}})},
      {"6 PM-midnight", night({{60, 420}})},
      {"18h30-23h", night({{90, 360}})},
      {"18.00-23.00", night({{60, 360}})},
      {"1800-0030", night({{60, 450}})},
      {"17:00-20:00;20:00-23:00", night({{0, 360}})},
      {"22:00-06:00 off", night({{0, 300}, {780, 840}})},
      {"17:00-07:00; 23:00-05:00 off", night({{0, 360}, {720, 840}})},
      {"sunset-sunrise; Mo-Th 23:00-05:00 off", night({{0, 360}, {720, 840}})},
      {"Sa 22:00-06:00 off", night({{0, 840}})},
      {"24/7; PH off", night({{0, 840}})},
      {"Oct-Mar 17:00-22:00", night({{0, 300}})},
      {"Oct-Mar: 17:00-22:00; Apr-Sep: 20:00-23:00", night({{0, 300}})},
      {"Apr-Sep 20:00-23:00; Oct-Mar 17:00-22:00", night({{0, 300}})},
      {"Oct 15-Mar 15 Mo-Fr 18:00-22:00", night({{60, 300}})},
      {"Jan,Nov,Dec sunset-23:00", night({{0, 360}})},
      {"Th 05:00-06:30", night({{720, 810}})},
      {"17:00-22:00; Dec 18:00-23:00", night({{60, 360}})},
  };
  for (const auto& [text, schedule] : known) {
    EXPECT_EQ(parse_lit_hours(text), schedule) << text;
  }
  for (const char* text : {"13pm-14pm", "0am-5am", "930-1200", "17:00-22:00+", "winter 17:00-22:00",
                           "+", "off on", "Oct- 17:00-22:00", "17:00-23:00,22:00-05:00 off",
                           "6-11pm", "easter 17:00-", "Mo-Fr 17:00-22:00 off off"})
    EXPECT_FALSE(parse_lit_hours(text)) << text;
}

// Our Wednesday is the 15th of its month, the third from both ends, and Thursday is the 16th.
TEST(NightSchedule, WeekdaysThatAreCountedInTheirMonth) {
  const NightSchedule evening{{minute_of(17, 0)}, {minute_of(22, 0)}};
  for (const char* text : {"We[3] 17:00-22:00", "We[-3] 17:00-22:00", "We[1,3] 17:00-22:00",
                           "We[2-4] 17:00-22:00", "Mo[1],We[3],Fr 17:00-22:00"}) {
    EXPECT_EQ(parse_lit_hours(text), evening) << text;
  }
  for (const char* text : {"We[1] 17:00-22:00", "We[-1] 17:00-22:00", "Mo[3] 17:00-22:00"})
    EXPECT_TRUE(parse_lit_hours(text).value_or(evening).never()) << text;
  EXPECT_EQ(parse_lit_hours("17:00-22:00; We[1] off"), evening);
  EXPECT_TRUE(parse_lit_hours("We[3] 17:00-22:00; We[3] off")->never());
  for (const char* text : {"We[1] +1 day 17:00-22:00", "We[6] 17:00-22:00", "We[] 17:00-22:00",
                           "We[3-1] 17:00-22:00", "We[x] 17:00-22:00"})
    EXPECT_FALSE(parse_lit_hours(text)) << text;
}

TEST(NightSchedule, YearsAndEaster) {
  setenv("SOURCE_DATE_EPOCH", "1789000000", 1);  // September 2026
  const NightSchedule evening{{minute_of(17, 0)}, {minute_of(22, 0)}};
  for (const char* text :
       {"2026 Dec 17:00-22:00", "2026 17:00-22:00", "2025-2027 Mo-Su 17:00-22:00",
        "2020+ 17:00-22:00", "2026 Dec 01-2027 Jan 15 17:00-22:00", "2026 Nov 20-Jan 6 17:00-22:00",
        "2026 Dec 15 17:00-22:00", "17:00-22:00; easter off",
        "17:00-22:00; easter -2 days-easter +1 day off", "easter-Dec 31 17:00-22:00",
        "2024 off; 17:00-22:00", "17:00-22:00; 2026 Dec 24-26 off", "Oct-Mar 17-22", "17-22",
        "sunset-22", "Mo-Fr 17-22:00"}) {
    EXPECT_EQ(parse_lit_hours(text), evening) << text;
  }
  for (const char* text :
       {"2025 Dec 17:00-22:00", "2020-2024 17:00-22:00", "2027+ 17:00-22:00", "easter 17:00-22:00",
        "Jan 1-easter 17:00-22:00", "2026 Jan 01-2026 Mar 15 17:00-22:00"}) {
    const auto hours = parse_lit_hours(text);
    ASSERT_TRUE(hours) << text;
    EXPECT_TRUE(hours->never()) << text;
  }
  // Easter may be 60 days before June 15, and four digits may be clocks.
  EXPECT_FALSE(parse_lit_hours("easter +60 days 17:00-22:00", Half::south));
  EXPECT_TRUE(parse_lit_hours("easter +60 days 17:00-22:00")->never());
  const NightSchedule hour{{minute_of(19, 0)}, {minute_of(20, 0)}};
  EXPECT_EQ(parse_lit_hours("1900-2000"), hour);
  for (const char* text : {"2026", "2026-", "2026 Dec-", "easter - 17:00-22:00", "18-23x", "18-25",
                           "Easter-3 17:00-22:00"})
    EXPECT_FALSE(parse_lit_hours(text)) << text;
  unsetenv("SOURCE_DATE_EPOCH");
}

// Nights are long in June there.
TEST(NightSchedule, SeasonsAreTurnedInTheSouth) {
  const std::pair<const char*, NightSchedule> known[] = {
      {"Oct-Mar 20:00-22:00; Apr-Sep 17:00-23:00", night({{0, 360}})},
      {"17:00-22:00; Jun-Aug 18:00-23:00", night({{60, 360}})},
      {"Jan,Nov,Dec sunset-23:00", NightSchedule{}},
      {"18:00-22:00", night({{60, 300}})},
  };
  for (const auto& [text, schedule] : known)
    EXPECT_EQ(parse_lit_hours(text, Half::south), schedule) << text;
  EXPECT_EQ(half_at(-33.87), Half::south);
  EXPECT_EQ(half_at(52.5), Half::north);
  EXPECT_EQ(read_lamp_tags({{"lit", "Apr-Sep 17:00-23:00"}}, Half::south).hours, night({{0, 360}}));
  EXPECT_TRUE(read_lamp_tags({{"lit", "Apr-Sep 17:00-23:00"}}, Half::north).unlit);
}

TEST(NightSchedule, HoursAreCountedAtFullHours) {
  HourCounts counts{};
  count_hours(night({{0, 61}, {780, 840}}), counts);  // 17:00-18:01, 06:00-07:00
  for (std::size_t hour = 0; hour < night_hours; ++hour)
    EXPECT_EQ(counts[hour], hour <= 1 || hour >= 13 ? 1u : 0u) << clock_hour(hour);
  EXPECT_EQ(clock_hour(0), 17);
  EXPECT_EQ(clock_hour(7), 0);
  EXPECT_EQ(clock_hour(14), 7);
}

}  // namespace
}  // namespace nightcity::lights
