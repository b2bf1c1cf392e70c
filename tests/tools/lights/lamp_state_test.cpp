// Lamps that are dark, and what the tag lit says.
#include "tools/lights/lamp_state.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <string>

#include "tools/lights/lamp_tags.h"
#include "tools/lights/lit_tag.h"

namespace nightcity::lights {
namespace {

TEST(LampState, BrokenGoneEndedAndBuriedLampsAreDarkAndNamed) {
  const struct {
    osm::OsmTags tags;
    const char* outage;
  } lamps[] = {
      {{{"operational_status", "broken"}}, "broken"},
      {{{"operational_status", "Out of order"}}, "broken"},
      {{{"operational_status", "operational"}}, ""},
      {{{"operational_status", "false"}}, "broken"},
      {{{"operational_status", "true"}}, ""},
      {{{"demolished", "yes"}}, "disused or demolished"},
      {{{"end_date", "2015-05-01"}}, "end_date past"},
      {{{"end_date", "1990s"}}, "end_date past"},
      {{{"end_date", "9999"}}, ""},
      {{{"start_date", "9998-01-01"}}, "start_date ahead"},
      {{{"start_date", "9998"}}, "start_date ahead"},
      {{{"start_date", "1998"}}, ""},
      {{{"end_date", "before 2015"}}, "end_date past"},
      {{{"end_date", "2010..2015"}}, "end_date past"},
      {{{"demolished", "2019-05"}}, "disused or demolished"},
      {{{"removed", "1"}}, "disused or demolished"},
      {{{"construction", "9998"}}, ""},
      {{{"disused", "no"}}, ""},
      {{{"operational_status", "dismantled"}}, "broken"},
      {{{"operational_status", "Retired"}}, "broken"},
      {{{"operational_status", "Abandoned In Place"}}, "broken"},
      {{{"operational_status", "not in service"}}, "broken"},
      {{{"operational_status",
         "Au\xc3\x9f"
         "er Betrieb"}},
       "broken"},
      {{{"operational_status", "operational;damaged"}}, "broken"},
      {{{"operational_status", "planned"}}, "broken"},
      {{{"operational_status", "In Service"}}, ""},
      {{{"operational_status", "Existing"}}, ""},
      {{{"end_date", "2010-05-03T12:00:00Z"}}, "end_date past"},
      {{{"opening_date", "9998-01-01"}}, "start_date ahead"},
      {{{"location", "underground"}}, "underground"},
      {{{"level", "-1"}}, "underground"},
      {{{"level", "0"}}, ""},
      {{{"layer", "1"}}, ""},
      {{{"lit", "none"}}, "lit=no"},
  };
  for (const auto& [tags, outage] : lamps) {
    const LampTags lamp = read_lamp_tags(tags);
    EXPECT_EQ(lamp.outage, outage) << tags.begin()->first << "=" << tags.begin()->second;
    EXPECT_EQ(lamp.unlit, outage[0] != 0);
    EXPECT_TRUE(lamp.unread.empty());
  }
  EXPECT_EQ(read_lamp_tags({{"operational_status", "In Service"}, {"start_date", "soon"}}).unread,
            (std::map<std::string, std::size_t>{{"start_date=soon", 1}}));
  EXPECT_EQ(read_lamp_tags({{"operational_status", "wobbly"}, {"end_date", "soon"}}).unread.size(),
            2u);
}

TEST(LampState, ADateEndsWithItsLastDay) {
  using namespace std::chrono;
  const auto expect = [](const char* text, Day first, Day last) {
    const auto days = parse_days(text);
    ASSERT_TRUE(days) << text;
    EXPECT_EQ(days->first, first) << text;
    EXPECT_EQ(days->last, last) << text;
  };
  expect("2015-05-01", 2015y / May / 1, 2015y / May / 1);
  expect("2015-02", 2015y / February / 1, 2015y / February / 28);
  expect("~2015", 2015y / January / 1, 2015y / December / 31);
  expect("1980s", 1980y / January / 1, 1989y / December / 31);
  expect("late 1980s", 1980y / January / 1, 1989y / December / 31);
  expect("C19", 1800y / January / 1, 1899y / December / 31);
  expect("2010..2015-03", 2010y / January / 1, 2015y / March / 31);
  expect("before 1950", Day::min(), 1950y / January / 1);
  for (const char* text : {"", "soon", "2015-13", "2015-02-30", "2015-05-01x", "3010..2015"})
    EXPECT_FALSE(parse_days(text)) << text;
}

TEST(LitTag, ConditionsTakeHoursFromTheNightOrGiveThem) {
  const auto lit = [](const char* text, bool is_lit) { return read_lit_condition(text, is_lit); };
  const NightSchedule evening_and_morning = dark_between(360, 720),
                      evening = dark_between(360, 840);
  EXPECT_EQ(lit("no @ (23:00-05:00)", true), evening_and_morning);
  EXPECT_EQ(lit("no @ 23:00-05:00", true), evening_and_morning);
  EXPECT_EQ(lit("off@(23:00-sunrise) ", true), evening);
  EXPECT_EQ(lit("yes @ (sunset-23:00)", false), evening);
  EXPECT_EQ(lit("yes @ (sunset-23:00; 05:00-sunrise)", false), evening_and_morning);
  for (const char* text : {"", "no", "no @", "no @ ()", "no @ (snow)", "yes @ (23:00-05:00)",
                           "no @ (sunset-sunrise)", "no @ (23:00-05:00); yes @ (Fr)", "@ (", "@"})
    EXPECT_FALSE(lit(text, true)) << text;

  osm::OsmTags tags{{"lit", "yes"}, {"lit:conditional", "no @ (23:00-05:00)"}};
  EXPECT_EQ(read_lamp_tags(tags).hours, evening_and_morning);
  tags["lit"] = "no";
  EXPECT_TRUE(read_lamp_tags(tags).unlit);
  EXPECT_EQ(read_lamp_tags(tags).unread.size(), 1u);
  tags["lit:conditional"] = "yes @ (sunset-23:00)";
  EXPECT_FALSE(read_lamp_tags(tags).unlit);
  EXPECT_EQ(read_lamp_tags(tags).hours, evening);
  tags["disused"] = "yes";
  EXPECT_TRUE(read_lamp_tags(tags).unlit);

  // Without `lit`, the hours of a condition are all the light there is.
  EXPECT_EQ(read_lamp_tags({{"lit:conditional", "yes @ (sunset-23:00)"}}).hours, evening);
  EXPECT_EQ(read_lamp_tags({{"lit:conditional", "no @ (23:00-05:00)"}}).hours, evening_and_morning);
  EXPECT_TRUE(read_lamp_tags({{"lit:conditional", "yes @ (Sa 17:00-23:00)"}}).unlit);
  EXPECT_TRUE(read_lamp_tags({{"lit", "Sa 17:00-23:00"}}).unlit);
  EXPECT_TRUE(read_lamp_tags({{"lit", "Sa 17:00-23:00"}}).unread.empty());
}

TEST(LitTag, EveryValueIsLitDarkUnknownOrNotUnderstood) {
  using Kind = LitTag::Kind;
  for (const char* text : {"yes", "24/7", "automatic", "sunset-sunrise", "dusk-dawn", "limited",
                           "interval", "20:00-06:00", "Mo-Su 18:00-23:00"})
    EXPECT_EQ(read_lit_tag(text).kind, Kind::lit) << text;
  for (const char* text : {"no", "disused", "none"})
    EXPECT_EQ(read_lit_tag(text).kind, Kind::dark) << text;
  for (const char* text : {"", "unknown"})
    EXPECT_EQ(read_lit_tag(text).kind, Kind::unknown) << text;
  for (const char* text : {"operating_times", "yes;no", "street_lamp"})
    EXPECT_EQ(read_lit_tag(text).kind, Kind::not_understood) << text;
  ASSERT_TRUE(read_lit_tag("20:00-06:00").hours);
  EXPECT_FALSE(read_lit_tag("20:00-06:00").hours->lit_at(minute_of(19, 0)));
  EXPECT_TRUE(read_lit_tag("20:00-06:00").hours->lit_at(minute_of(2, 0)));
  EXPECT_FALSE(read_lit_tag("limited").hours->lit_at(minute_of(2, 0)));
}

}  // namespace
}  // namespace nightcity::lights
