// Dates of rules of hours: years, seasons, days of a month and Easter.
#pragma once

#include <string_view>

namespace nightcity::lights {

/// The day of our night's evening. Months count from January, 0.
struct NightDay {
  int year, month, day;
};

enum class DatesHold { not_said, yes, no, unread };

/// Takes the dates off the front of a rule in lower case ("2025-2027", "oct-mar", "dec 24-26",
/// "2026 dec 01-2027 jan 15", "easter -2 days-easter +1 day") and says whether our night is among
/// them. Easter is a day from March 22 to April 25; where that decides, the dates are unread.
DatesHold take_dates(std::string_view& text, const NightDay& night);

/// Returns whether a day, month or week lies in a range that may go on behind the end of the year.
constexpr bool is_within(int at, int first, int last) {
  return first <= last ? first <= at && at <= last : first <= at || at <= last;
}

}  // namespace nightcity::lights
