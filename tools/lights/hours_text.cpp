#include "tools/lights/hours_text.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>

#include "formats/to_lower.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr int hour = 60, day = 24 * hour;
constexpr int sunset = 17 * hour, sunrise = 7 * hour;  // around our night
// The day of the night's evening; its morning is the next one's.
constexpr int wednesday = 2, june = 5, december = 11, day_of_month = 15;

bool is_figure(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80;
}

void skip_spaces(string_view& text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
}

bool take(string_view& text, string_view sign) {
  string_view rest = text;
  skip_spaces(rest);
  if (!rest.starts_with(sign)) return false;
  rest.remove_prefix(sign.size());
  text = rest;
  return true;
}

// Takes one of the words off the front, where no other letter follows, and returns its number.
std::optional<int> take_word(string_view& text, std::initializer_list<string_view> words) {
  string_view rest = text;
  skip_spaces(rest);
  std::size_t size = 0;
  while (size < rest.size() && is_letter(rest[size])) ++size;
  const auto found = std::find(words.begin(), words.end(), rest.substr(0, size));
  if (size == 0 || found == words.end()) return {};
  text = rest.substr(size);
  return static_cast<int>(found - words.begin());
}

std::optional<int> take_digits(string_view& text, std::size_t most) {
  std::size_t size = 0;
  int value = 0;
  for (; size < text.size() && is_figure(text[size]); ++size)
    if (size < most) value = 10 * value + text[size] - '0';
  if (size == 0 || size > most) return {};
  text.remove_prefix(size);
  return value;
}

// A number of a day in its month, behind which no clock goes on ("Dec 24", not "Dec 17:00").
std::optional<int> take_day_of_month(string_view& text) {
  string_view rest = text;
  skip_spaces(rest);
  string_view clock = rest;
  if (take_clock(clock)) return {};
  const auto number = take_digits(rest, 2);
  if (!number || *number < 1 || *number > 31) return {};
  text = rest;
  return number;
}

std::optional<int> take_month(string_view& text) {
  return take_word(
      text, {"jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"});
}

// The numbers are those of weekdays from Monday; 7 and 8 are holidays of the public and of schools.
std::optional<int> take_weekday(string_view& text) {
  return take_word(text, {"mo", "tu", "we", "th", "fr", "sa", "su", "ph", "sh"});
}

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
    if (!read_seasons(rule) || !read_weekdays(rule)) return false;
    if (rule.is_for_some_days) take(text_, ":");
    if (take(text_, "24/7")) {
      rule.spans.push_back({0, day});
    } else if (!read_spans(rule)) {
      return false;
    }
    const auto state = take_word(text_, {"off", "closed", "on", "open"});
    rule.is_off = state && *state < 2;
    return !rule.spans.empty() || rule.is_off;
  }

  // Reads "Oct-Mar", "Jan,Feb", "Oct 15-Mar 15", "Dec 24-26".
  bool read_seasons(HoursRule& rule) {
    bool holds = false;
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
      rule.is_for_some_days = true;
      if (!take(behind, ",")) break;
    }
    if (rule.is_for_some_days) rule.holds.fill(holds);
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
      if (take(behind, "-") || take(behind, "_")) {
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

std::optional<int> take_clock(string_view& text) {
  string_view rest = text;
  if (const auto word = take_word(rest, {"noon", "midnight"})) {
    text = rest;
    return *word == 0 ? 12 * hour : day;
  }
  skip_spaces(rest);
  auto hours = take_digits(rest, 2);
  std::optional<int> minutes;
  if (!hours) {  // "1800"
    const std::size_t before = rest.size();
    const auto both = take_digits(rest, 4);
    if (!both || before - rest.size() != 4) return {};
    hours = *both / 100;
    minutes = *both % 100;
  } else if (rest.starts_with(':') || rest.starts_with('.') || rest.starts_with('h')) {
    const bool has_word = rest.front() == 'h';
    string_view behind = rest.substr(1);
    const std::size_t before = behind.size();
    minutes = take_digits(behind, 2);
    if (minutes ? before - behind.size() != 2 : !has_word) return {};
    if (!minutes) minutes = 0;
    rest = behind;
  }
  if (const auto half = take_word(rest, {"am", "pm"})) {
    if (*hours < 1 || *hours > 12) return {};
    hours = *hours % 12 + (*half == 1 ? 12 : 0);
  } else if (!minutes) {
    return {};  // a number alone is no clock
  }
  if (minutes.value_or(0) > 59 || *hours > 48) return {};
  text = rest;
  return *hours * hour + minutes.value_or(0);
}

std::optional<std::vector<HoursRule>> read_hours_rules(string_view text, Half half) {
  const std::string lower = to_lower(osm::to_plain_signs(text));
  return RuleReader(lower, half).read();
}

}  // namespace nightcity::lights
