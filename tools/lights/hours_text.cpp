#include "tools/lights/hours_text.h"

#include <string>
#include <utility>

#include "formats/to_lower.h"
#include "tools/lights/hours_words.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr int hour = 60, day = 24 * hour;
constexpr int sunset = 17 * hour, sunrise = 7 * hour;  // around our night
// The day of the night's evening; its morning is the next one's.
constexpr int wednesday = 2, june = 5, december = 11, day_of_month = 15;
constexpr int week_of_june = 25, week_of_december = 51;

bool is_within(int at, int first, int last) {
  return first <= last ? first <= at && at <= last : first <= at || at <= last;
}

class RuleReader {
 public:
  RuleReader(string_view text, Half half)
      : text_(text), month_(half == Half::south ? june : december) {}

  std::optional<std::vector<HoursRule>> read() {
    std::vector<HoursRule> rules;
    do {
      skip_spaces(text_);
      if (text_.empty() && !rules.empty()) break;  // behind a last semicolon
      HoursRule rule;
      if (!read_rule(rule)) return {};
      rules.push_back(std::move(rule));
    } while (take(text_, ";") || take(text_, ","));
    skip_spaces(text_);
    if (!text_.empty()) return {};
    return rules;
  }

 private:
  bool read_rule(HoursRule& rule) {
    if (!read_weeks(rule) || !read_seasons(rule) || !read_weekdays(rule)) return false;
    if (rule.is_for_some_days) take(text_, ":");
    if (take(text_, "24/7")) {
      rule.spans.push_back({0, day});
    } else if (!read_spans(rule)) {
      return false;
    }
    const auto state = take_word(text_, {"off", "closed", "on", "open"});
    rule.is_off = state && *state < 2;
    skip_spaces(text_);
    const bool ends = text_.empty() || text_.starts_with(';');
    // Days without hours are whole days.
    if (rule.spans.empty() && !rule.is_off && rule.is_for_some_days && ends)
      rule.spans.push_back({0, day});
    return !rule.spans.empty() || rule.is_off;
  }

  // Reads "week 40-53", "week 1-13,40-53". Every second week may be ours or not.
  bool read_weeks(HoursRule& rule) {
    if (!take_word(text_, {"week"})) return true;
    const int week = month_ == june ? week_of_june : week_of_december;
    bool holds = false;
    do {
      skip_spaces(text_);
      const auto first = take_digits(text_, 2);
      auto last = first;
      if (first && take(text_, "-")) last = take_digits(text_, 2);
      if (!first || !last || text_.starts_with('/')) return false;
      holds = holds || is_within(week, *first, *last);
    } while (take(text_, ","));
    rule.is_for_some_days = true;
    rule.holds.fill(holds);
    return true;
  }

  // Reads "Oct-Mar", "Jan,Feb", "Oct 15-Mar 15", "Dec 24-26".
  bool read_seasons(HoursRule& rule) {
    bool holds = false, any = false;
    string_view behind = text_;
    while (const auto month = take_month(behind)) {
      const auto number = take_day_of_month(behind);
      int first = 100 * *month + number.value_or(1), last = 100 * *month + number.value_or(31);
      if (string_view to = behind; take(to, "-")) {
        const auto last_month = take_month(to);
        const auto last_number = take_day_of_month(to);
        if (!last_month && !last_number) return false;
        last = 100 * last_month.value_or(*month) + last_number.value_or(31);
        behind = to;
      }
      holds = holds || is_within(100 * month_ + day_of_month, first, last);
      text_ = behind;
      any = true;
      if (!take(behind, ",")) break;
    }
    rule.is_for_some_days = rule.is_for_some_days || any;
    for (bool& day_holds : rule.holds) day_holds = day_holds && (holds || !any);
    return true;
  }

  // Reads "Mo-Fr", "Sa,Su", "Mo, We", "PH".
  bool read_weekdays(HoursRule& rule) {
    std::array<bool, 2> holds{};
    bool any = false;
    string_view behind = text_;
    while (const auto first = take_weekday(behind)) {
      auto last = first;
      if (take(behind, "-") && !(last = take_weekday(behind))) return false;
      for (int n = 0; n < 2; ++n)
        if (*first < 7 && *last < 7 && is_within(wednesday + n, *first, *last))
          holds[static_cast<std::size_t>(n)] = true;
      any = true;
      text_ = behind;
      if (!take(behind, ",")) break;
    }
    if (!any) return true;
    rule.is_for_some_days = true;
    for (std::size_t n = 0; n < holds.size(); ++n) rule.holds[n] = rule.holds[n] && holds[n];
    return true;
  }

  // Reads spans while commas lead to further ones. Returns false where one cannot be read or
  // overlaps another.
  bool read_spans(HoursRule& rule) {
    string_view behind = text_;
    while (const auto from = take_edge(behind)) {
      HoursSpan span{*from, 0};
      if (take(behind, "-") || take(behind, "_") || take(behind, "/")) {
        const auto to = take_edge(behind);
        if (!to || *from > day) return false;
        span.to = *to <= *from ? *to + day : *to;
      } else if (take(behind, "+")) {  // an open end: to the end of the night
        span.to = sunrise + (*from < sunrise ? 0 : day);
      } else {
        return false;
      }
      for (const HoursSpan& other : rule.spans)
        if (span.from < other.to && other.from < span.to) return false;
      rule.spans.push_back(span);
      text_ = behind;
      if (!take(behind, ",")) break;
    }
    return true;
  }

  static std::optional<int> take_event(string_view& text) {
    const auto event = take_word(text, {"sunset", "dusk", "sunrise", "dawn"});
    if (!event) return {};
    return *event < 2 ? sunset : sunrise;
  }

  // Takes the beginning or the end of a span off the front: a clock, an event of the sun, or
  // "(sunset+01:00)".
  static std::optional<int> take_edge(string_view& text) {
    string_view rest = text;
    std::optional<int> minute;
    if (take(rest, "(")) {
      minute = take_event(rest);
      const bool later = take(rest, "+");
      if (!minute || (!later && !take(rest, "-"))) return {};
      const auto offset = take_clock(rest);
      if (!offset || !take(rest, ")")) return {};
      *minute += later ? *offset : -*offset;
    } else if (!(minute = take_event(rest))) {
      minute = take_clock(rest);
    }
    if (minute) text = rest;
    return minute;
  }

  string_view text_;
  int month_;  // of our night
};

}  // namespace

std::optional<std::vector<HoursRule>> read_hours_rules(string_view text, Half half) {
  constexpr std::size_t longest = 1024;  // OpenStreetMap allows 255
  if (text.size() > longest) return {};
  const std::string lower = to_plain_hours(to_lower(osm::to_plain_signs(text)));
  return RuleReader(lower, half).read();
}

}  // namespace nightcity::lights
