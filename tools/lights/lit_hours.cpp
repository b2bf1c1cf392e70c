#include "tools/lights/lit_hours.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <string>
#include <vector>

#include "formats/to_lower.h"
#include "tools/lights/hours_text.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

using Minutes = std::bitset<night_minutes>;
constexpr int day_minutes = 24 * 60, night_begin_minute = 60 * night_begin_hour;

// Marks the part of a span, in minutes after midnight of a day, that lies in our night, which
// begins on the day `days_before`.
void mark(const HoursSpan& span, int days_before, Minutes& minutes) {
  const int shift = days_before * day_minutes - night_begin_minute;
  const int to = std::min(span.to + shift, night_minutes);
  for (int minute = std::max(span.from + shift, 0); minute < to; ++minute)
    minutes.set(static_cast<std::size_t>(minute));
}

// Goes through the rules in their order. Our night takes hours from two days: its evening's and its
// morning's.
class NightOfRules {
 public:
  // Returns false where the rule contradicts one before it.
  bool add(const HoursRule& rule) {
    std::array<Minutes, 2> hours;
    for (std::size_t day = 0; day < hours.size(); ++day)
      for (const HoursSpan& span : rule.spans)
        if (rule.holds[day]) mark(span, static_cast<int>(day), hours[day]);
    if (rule.is_off) {
      const Minutes off = hours[0] | hours[1];
      takes_hours_ = true;
      off_ |= off;
      if (rule.spans.empty())
        for (int day = 0; day < 2; ++day)
          if (rule.holds[static_cast<std::size_t>(day)]) mark({0, day_minutes}, day, off_);
      for (std::size_t day = 0; day < hours.size(); ++day)
        lit_[day] = rule.spans.empty() && rule.holds[day] ? Minutes() : lit_[day] & ~off;
      return true;
    }
    gives_hours_ = true;
    const bool overlaps = ((lit_[0] | lit_[1]) & (hours[0] | hours[1])).any();
    if (overlaps && !rule.is_for_some_days) return false;
    for (std::size_t day = 0; day < hours.size(); ++day) {
      // A later rule for some days goes before an earlier one for more.
      if (overlaps && rule.holds[day]) lit_[day].reset();
      lit_[day] |= hours[day];
    }
    return true;
  }

  // Hours that are off alone are taken from the whole night.
  std::optional<NightSchedule> to_schedule() const {
    if (!gives_hours_ && !takes_hours_) return {};
    const Minutes lit = gives_hours_ ? lit_[0] | lit_[1] : ~off_;
    NightSchedule schedule;
    std::size_t used = 0;
    for (std::size_t minute = 0; minute < lit.size(); ++minute) {
      const bool begins = lit[minute] && (minute == 0 || !lit[minute - 1]);
      const bool ends = lit[minute] && (minute + 1 == lit.size() || !lit[minute + 1]);
      if (begins && used == schedule.on.size()) return {};
      if (begins) schedule.on[used] = static_cast<std::uint16_t>(minute);
      if (ends) schedule.off[used++] = static_cast<std::uint16_t>(minute + 1);
    }
    return schedule;
  }

 private:
  std::array<Minutes, 2> lit_;  // by the rules of the evening's day and of the morning's
  Minutes off_;
  bool gives_hours_ = false, takes_hours_ = false;
};

}  // namespace

std::optional<NightSchedule> parse_lit_hours(std::string_view text, Half half) {
  const std::optional<std::vector<HoursRule>> rules = read_hours_rules(text, half);
  if (!rules) return {};
  NightOfRules night;
  for (const HoursRule& rule : *rules)
    if (!night.add(rule)) return {};
  return night.to_schedule();
}

}  // namespace nightcity::lights
