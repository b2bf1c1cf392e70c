#include "tools/lights/night_schedule.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tools/osm/tag_values.h"
#include "tools/random.h"

namespace nightcity::lights {
namespace {

uint second_of(int minute) {
  return night_begin_s + 60 * static_cast<uint>(minute);
}

/// Parses "23:00", "7:05" or "0:30" as minutes after 17:00. Empty for other texts.
std::optional<int> clock_minute(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0 || colon > 2 || text.size() != colon + 3)
    return std::nullopt;
  int parts[2] = {0, 0};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i == colon) continue;
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    int& part = parts[i > colon];
    part = 10 * part + text[i] - '0';
  }
  if (parts[0] > 48 || parts[1] > 59) return std::nullopt;  // 26:00 is 2:00 of the next day
  return minute_of(parts[0] % 24, parts[1]);
}

/// Parses the beginning or end of a span of hours. The sun sets before our night and rises after
/// it; "(sunset+01:00)", whose minus the tag's normal form turned into an underscore, is an hour
/// after the first.
std::optional<int> edge_of_light(std::string_view text) {
  if (text.starts_with('(') && text.ends_with(')')) {
    text = text.substr(1, text.size() - 2);
    const std::size_t sign = text.find_first_of("+_");
    if (sign == std::string_view::npos) return std::nullopt;
    const auto event = edge_of_light(text.substr(0, sign));
    const auto offset = clock_minute(text.substr(sign + 1));
    if (!event || !offset || text.front() < 'a') return std::nullopt;
    const int minutes = (*offset + 60 * night_begin_hour) % (24 * 60);
    return std::clamp(*event + (text[sign] == '+' ? minutes : -minutes), 0, night_minutes);
  }
  if (text == "sunset" || text == "dusk") return 0;
  if (text == "sunrise" || text == "dawn") return night_minutes;
  return clock_minute(text);
}

/// The days that stand before hours ("Mo-Fr", "Sa,Su", "PH"), and whether these hold in our night:
/// a Wednesday's, because traffic is a weekday's.
class DayRule {
 public:
  /// Takes the days off the front of a part that was cut at commas.
  void take(std::string_view& part) {
    while (true) {
      const std::optional<int> first = take_day(part);
      if (!first) return;
      std::string_view behind = part.substr(part.starts_with("_") ? 1 : 0);
      const std::optional<int> last = part.starts_with("_") ? take_day(behind) : std::nullopt;
      if (last) part = behind;
      const int to = last.value_or(*first);
      if (has_hours_) holds_ = false;  // the days of another rule
      has_hours_ = false;
      names_days_ = true;
      const bool within = *first <= to ? *first <= wednesday && wednesday <= to
                                       : *first <= wednesday || wednesday <= to;
      holds_ = holds_ || (*first < week && to < week && within);
      while (part.starts_with("_")) part.remove_prefix(1);
    }
  }
  bool names_days() const { return names_days_; }
  bool holds() const { return !names_days_ || holds_; }
  void end_hours(bool ends_rule) {
    has_hours_ = true;
    if (ends_rule) *this = {};
  }

 private:
  static constexpr int wednesday = 2, week = 7;

  /// Returns the number of a day; 7 for holidays of the public and of schools.
  static std::optional<int> take_day(std::string_view& text) {
    constexpr std::array<std::string_view, 9> names{"mo", "tu", "we", "th", "fr",
                                                    "sa", "su", "ph", "sh"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!text.starts_with(names[i])) continue;
      if (text.size() > 2 && text[2] != '_') continue;
      text.remove_prefix(2);
      return std::min(static_cast<int>(i), week);
    }
    return std::nullopt;
  }

  bool names_days_ = false, holds_ = false, has_hours_ = false;
};

}  // namespace

bool NightSchedule::lit_at(int minute) const {
  for (std::size_t n = 0; n < on.size(); ++n)
    if (minute >= on[n] && minute < off[n]) return true;
  return false;
}

bool NightSchedule::never() const {
  for (std::size_t n = 0; n < on.size(); ++n)
    if (on[n] < off[n]) return false;
  return true;
}

NightSchedule dark_between(int off, int on) {
  NightSchedule schedule;
  std::size_t used = 0;
  const auto add = [&](int from, int to) {
    if (from >= to) return;
    schedule.on[used] = static_cast<std::uint16_t>(from);
    schedule.off[used++] = static_cast<std::uint16_t>(to);
  };
  add(0, std::clamp(off, 0, night_minutes));
  add(std::clamp(on, 0, night_minutes), night_minutes);
  return schedule;
}

std::optional<NightSpan> parse_night_span(std::string_view text) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const auto from = clock_minute(text.substr(0, dash)), to = clock_minute(text.substr(dash + 1));
  if (!from || !to || *to > night_minutes || *from >= *to) return std::nullopt;
  return NightSpan{*from, *to};
}

std::optional<NightSchedule> parse_lit_hours(std::string_view text) {
  // Blanks and dashes become underscores.
  const std::string value = osm::normalise_tag(osm::to_plain_signs(text));
  if (value == "24/7" || value == "00:00_24:00") return dark_between(night_minutes, night_minutes);
  std::vector<NightSpan> spans;
  DayRule days;
  std::string_view rest = value;
  while (!rest.empty()) {
    const std::size_t end = rest.find_first_of(";,");
    std::string_view part = rest.substr(0, end);
    const bool ends_rule = end != std::string_view::npos && rest[end] == ';';
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    while (part.starts_with("_")) part.remove_prefix(1);
    days.take(part);
    if (part.empty()) {  // "Mo,We 17:00-22:00": the hours come behind a further day
      if (ends_rule || rest.empty()) return std::nullopt;
      continue;
    }
    const bool holds = days.holds();
    const bool replaces = days.names_days();
    days.end_hours(ends_rule);
    if (part == "off" && replaces) {
      if (holds) spans.clear();
      continue;
    }
    const std::size_t event_end = part.starts_with("(") ? part.find(')') : 0;
    const std::size_t dash = part.find('_', std::min(event_end, part.size()));
    if (dash == std::string_view::npos) return std::nullopt;
    std::string_view end_part = part.substr(dash);
    while (end_part.starts_with("_")) end_part.remove_prefix(1);
    auto from = edge_of_light(part.substr(0, dash)), to = edge_of_light(end_part);
    if (!from || !to) return std::nullopt;
    if (!holds) continue;
    if (*from > night_minutes && *to > night_minutes && *from < *to) continue;  // by day only
    // A span that begins before 17:00 is lit when the night begins; one that ends by day is lit
    // until its end.
    if (*from > night_minutes) from = 0;
    to = std::min(*to, night_minutes);
    if (*from >= *to) continue;
    const auto overlaps = [&](const NightSpan& other) {
      return *from <= other.to && other.from <= *to;
    };
    if (std::any_of(spans.begin(), spans.end(), overlaps)) {
      if (!replaces) return std::nullopt;
      spans.clear();  // a later rule for some days goes before an earlier one for more
    }
    spans.push_back({*from, *to});
  }
  NightSchedule schedule;
  if (spans.empty() || spans.size() > schedule.on.size()) return std::nullopt;
  std::sort(spans.begin(), spans.end(),
            [](const NightSpan& a, const NightSpan& b) { return a.from < b.from; });
  for (std::size_t i = 0; i < spans.size(); ++i) {
    schedule.on[i] = static_cast<std::uint16_t>(spans[i].from);
    schedule.off[i] = static_cast<std::uint16_t>(spans[i].to);
  }
  return schedule;
}

std::size_t ScheduleTable::Hash::operator()(const NightSchedule& schedule) const {
  std::uint64_t hash = 0;
  for (std::size_t n = 0; n < schedule.on.size(); ++n)
    hash = mix(hash ^ (std::uint64_t{schedule.on[n]} << 16 | schedule.off[n]));
  return hash;
}

std::uint32_t ScheduleTable::add(const NightSchedule& schedule) {
  if (const auto known = known_.find(schedule); known != known_.end()) return known->second;
  std::array<uint, 2 * std::tuple_size_v<decltype(schedule.on)>> switches;
  std::size_t count = 0;
  for (std::size_t n = 0; n < schedule.on.size(); ++n) {
    if (schedule.on[n] >= schedule.off[n]) continue;
    switches[count++] = second_of(schedule.on[n]);
    switches[count++] = second_of(schedule.off[n]);
  }
  const std::uint32_t number = store_(std::span(switches).first(count));
  ++size_;
  if (known_.size() >= max_known_) known_.clear();
  known_.emplace(schedule, number);
  return number;
}

void count_hours(const NightSchedule& schedule, HourCounts& counts) {
  for (std::size_t hour = 0; hour < night_hours; ++hour)
    counts[hour] += schedule.lit_at(std::min(static_cast<int>(hour) * 60, night_minutes - 1));
}

}  // namespace nightcity::lights
