#include "tools/lights/hours_dates.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "tools/lights/hours_words.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr std::array<int, 12> month_days{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
// The days of a year, from 1, on which Easter may fall: March 22 and April 25.
constexpr int first_easter = 31 + 28 + 22, last_easter = 31 + 28 + 31 + 25;

/// A date of a rule as 100 * month + day. Easter has an earliest and a latest.
struct RuleDate {
  std::optional<int> year;
  int low = 0, high = 0;
  bool has_day = false, is_easter = false;
};

int to_date(int day_of_year) {
  int month = 0;
  for (; month < 11 && day_of_year > month_days[static_cast<std::size_t>(month)]; ++month)
    day_of_year -= month_days[static_cast<std::size_t>(month)];
  return 100 * month + day_of_year;
}

bool begins_with_digit(string_view text) {
  skip_spaces(text);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

std::optional<int> take_year(string_view& text) {
  string_view rest = text;
  skip_spaces(rest);
  const std::size_t before = rest.size();
  const auto year = take_digits(rest, 4);
  if (!year || before - rest.size() != 4 || *year < 1900 || *year > 2099) return {};
  text = rest;
  return year;
}

/// Takes "-2 days" or "+1 day" behind Easter.
int take_offset(string_view& text) {
  string_view rest = text;
  const bool later = take(rest, "+");
  if (!later && !take(rest, "-")) return 0;
  skip_spaces(rest);
  const auto days = take_digits(rest, 2);
  if (!days || !take_word(rest, {"day", "days"})) return 0;
  text = rest;
  return later ? *days : -*days;
}

std::optional<RuleDate> take_date(string_view& text) {
  string_view rest = text;
  RuleDate date;
  date.year = take_year(rest);
  if (take_word(rest, {"easter"})) {
    const int offset = take_offset(rest);
    date.low = to_date(first_easter + offset);
    date.high = to_date(last_easter + offset);
    date.has_day = date.is_easter = true;
  } else if (const auto month = take_month(rest)) {
    const auto day = take_day_of_month(rest);
    date.low = date.high = 100 * *month + day.value_or(0);
    date.has_day = day.has_value();
  } else {
    return {};
  }
  text = rest;
  return date;
}

/// Takes years that stand before other dates, days or hours: "2025", "2025-2027", "2025+". Four
/// digits may be a clock as well ("2000-2200").
DatesHold take_years(string_view& text, int year) {
  string_view rest = text;
  const auto first = take_year(rest);
  if (!first) return DatesHold::not_said;
  auto last = first;
  bool is_range = true;
  if (string_view to = rest; take(to, "-")) {
    last = take_year(to);
    if (!last) return DatesHold::not_said;
    rest = to;
  } else if (take(rest, "+")) {
    last = 9999;
  } else if (string_view to = rest; take_month(to) || take_word(to, {"easter"})) {
    return DatesHold::not_said;  // the year of a date
  } else {
    is_range = false;
  }
  string_view behind = rest;
  const bool goes_on = take_month(behind) || take_weekday(behind) ||
                       take_word(behind, {"easter", "week", "sunset", "dusk"}) ||
                       (!is_range && take_word(behind, {"off", "closed"})) ||
                       (rest.starts_with(' ') && take_clock(behind));
  if (!goes_on) return DatesHold::not_said;
  text = rest;
  return *first <= year && year <= *last ? DatesHold::yes : DatesHold::no;
}

class DateReader {
 public:
  DateReader(string_view& text, const NightDay& night)
      : text_(text), night_(night), at_(100 * night.month + night.day) {}

  DatesHold read() {
    const DatesHold years = take_years(text_, night_.year);
    bool holds = false, any = false;
    string_view behind = text_;
    while (const auto first = take_date(behind)) {
      RuleDate last = *first;
      if (string_view to = behind; take(to, "-")) {
        if (!take_end(to, *first, last)) return DatesHold::unread;
        behind = to;
      }
      const auto is_in = find_out(*first, last);
      if (!is_in) return DatesHold::unread;
      holds = holds || *is_in;
      text_ = behind;
      any = true;
      if (!take(behind, ",")) break;
    }
    if (!any) return years;
    return holds && years != DatesHold::no ? DatesHold::yes : DatesHold::no;
  }

 private:
  /// Takes the end of a range: a date, or the day alone ("dec 24-26").
  static bool take_end(string_view& text, const RuleDate& first, RuleDate& last) {
    string_view rest = text;
    if (const auto date = take_date(rest)) {
      last = *date;
      // "oct-mar 18-23": what follows two months are hours.
      if (last.has_day && !first.has_day && take(rest, "-") && begins_with_digit(rest)) {
        last.low = last.high = last.low / 100 * 100;
        last.has_day = false;
        take_year(text);
        take_month(text);
        return true;
      }
      take_date(text);
      return true;
    }
    const auto day = take_day_of_month(text);
    if (!day || first.is_easter) return false;
    last.low = last.high = first.low / 100 * 100 + *day;
    last.has_day = true;
    return true;
  }

  /// Says whether our night lies between two dates; empty where Easter decides it.
  std::optional<bool> find_out(const RuleDate& first, const RuleDate& last) const {
    std::optional<bool> known;
    for (const int from : {first.low, first.high})
      for (const int to : {last.low, last.high}) {
        if (first.is_easter && last.is_easter && from == first.high && to == last.low &&
            first.low != first.high)
          continue;  // Easter is on one day of a year
        const bool is_in = holds(first, from, last, to);
        if (known && *known != is_in) return {};
        known = is_in;
      }
    // A day of Easter may be any of its days.
    if (known && *known && first.is_easter && last.is_easter) return {};
    return known;
  }

  bool holds(const RuleDate& first, int from, const RuleDate& last, int to) const {
    const int begin = from + (first.has_day ? 0 : 1), end = to + (last.has_day ? 0 : 31);
    if (!first.year) return is_within(at_, begin, end);
    const int last_year = last.year.value_or(*first.year + (end < begin ? 1 : 0));
    const std::pair now(night_.year, at_);
    return std::pair(*first.year, begin) <= now && now <= std::pair(last_year, end);
  }

  string_view& text_;
  NightDay night_;
  int at_;
};

}  // namespace

DatesHold take_dates(string_view& text, const NightDay& night) {
  return DateReader(text, night).read();
}

}  // namespace nightcity::lights
