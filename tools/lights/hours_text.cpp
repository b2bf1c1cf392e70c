#include "tools/lights/hours_text.h"

#include <chrono>
#include <string>
#include <utility>

#include "formats/to_lower.h"
#include "tools/lights/hours_dates.h"
#include "tools/lights/hours_words.h"
#include "tools/osm/tag_values.h"
#include "tools/today.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr int hour = 60, day = 24 * hour;
constexpr int sunset = 17 * hour, sunrise = 7 * hour;  // around our night
// The day of the night's evening; its morning is the next one's.
constexpr int wednesday = 2, june = 5, december = 11, day_of_month = 15;
constexpr int week_of_june = 25, week_of_december = 51;
// Both days are the third of their weekday in their month, from its beginning and from its end.
constexpr int occurrence = 3;

int find_this_year() {
  return static_cast<int>(std::chrono::year_month_day(today()).year());
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
    if (!read_weeks(rule) || !read_dates(rule) || !read_weekdays(rule)) return false;
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

  static bool begins_with_minutes(string_view text) {
    return text.size() > 1 && text[0] == ':' && text[1] >= '0' && text[1] <= '9';
  }

  // Reads "week 40-53", "week 1-13,40-53".
  bool read_weeks(HoursRule& rule) {
    if (!take_word(text_, {"week"})) return true;
    const int week = month_ == june ? week_of_june : week_of_december;
    bool holds = false;
    do {
      skip_spaces(text_);
      const auto first = take_digits(text_, 2);
      auto last = first;
      if (first && take(text_, "-")) last = take_digits(text_, 2);
      // Every second week may be ours or not, and a number before minutes is an hour.
      if (!first || !last || text_.starts_with('/') || begins_with_minutes(text_)) return false;
      holds = holds || is_within(week, *first, *last);
    } while (take(text_, ","));
    rule.is_for_some_days = true;
    rule.holds.fill(holds);
    return true;
  }

  // Reads "Oct-Mar", "2025 Dec 24-26", "easter". There is no year in a night of ours: it is this
  // one, as for all dates of a map.
  bool read_dates(HoursRule& rule) {
    const DatesHold dates = take_dates(text_, {find_this_year(), month_, day_of_month});
    if (dates == DatesHold::unread) return false;
    if (dates == DatesHold::not_said) return true;
    rule.is_for_some_days = true;
    for (bool& day_holds : rule.holds) day_holds = day_holds && dates == DatesHold::yes;
    return true;
  }

  // Takes "[1]", "[1,3]", "[-1]" behind a weekday, which count it in its month. Returns whether
  // ours is among them; empty where that cannot be read.
  static std::optional<bool> take_occurrences(string_view& text) {
    bool holds = false;
    do {
      take(text, "-");  // from the end, where ours has the same number
      const auto first = take_digits(text, 1);
      auto last = first;
      if (first && take(text, "-")) last = take_digits(text, 1);
      if (!first || !last || *first < 1 || *first > *last || *last > 5) return {};
      holds = holds || is_within(occurrence, *first, *last);
    } while (take(text, ","));
    if (!take(text, "]")) return {};
    // "We[1] +1 day" is another day.
    if (string_view rest = text; take(rest, "+") || take(rest, "-")) return {};
    return holds;
  }

  // Reads "Mo-Fr", "Sa,Su", "Mo, We", "We[1]", "PH".
  bool read_weekdays(HoursRule& rule) {
    std::array<bool, 2> holds{};
    bool any = false;
    string_view behind = text_;
    while (const auto first = take_weekday(behind)) {
      auto last = first;
      bool is_ours = true;
      if (take(behind, "[")) {
        const auto ours = take_occurrences(behind);
        if (!ours) return false;
        is_ours = *ours;
      } else if (take(behind, "-") && !(last = take_weekday(behind))) {
        return false;
      }
      for (int n = 0; n < 2; ++n)
        if (is_ours && *first < 7 && *last < 7 && is_within(wednesday + n, *first, *last))
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
    while (const auto from = take_begin(behind)) {
      HoursSpan span{*from, 0};
      if (take(behind, "-") || take(behind, "_") || take(behind, "/")) {
        const auto to = take_end(behind);
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

  // Takes an hour without minutes off the front: "18".
  static std::optional<int> take_bare_hour(string_view& text) {
    string_view rest = text;
    skip_spaces(rest);
    const auto hours = take_digits(rest, 2);
    if (!hours || *hours > 24) return {};
    text = rest;
    return *hours * hour;
  }

  // Takes the beginning of a span: an edge, or the hour of "18-23". That of "6-11pm" is one of the
  // evening, and not read.
  static std::optional<int> take_begin(string_view& text) {
    if (const auto edge = take_edge(text)) return edge;
    string_view rest = text;
    const auto hours = take_bare_hour(rest);
    string_view to = rest;
    if (!hours || !take(to, "-")) return {};
    const std::size_t before = to.size();
    if (!take_end(to)) return {};
    if (rest.substr(rest.size() - before, before - to.size()).ends_with('m')) return {};
    text = rest;
    return hours;
  }

  // Takes the end of a span: an edge, or an hour behind which no number or word goes on.
  static std::optional<int> take_end(string_view& text) {
    if (const auto edge = take_edge(text)) return edge;
    string_view rest = text;
    const auto hours = take_bare_hour(rest);
    if (!hours || !(rest.empty() || rest.find_first_of(" ,;") == 0)) return {};
    text = rest;
    return hours;
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
