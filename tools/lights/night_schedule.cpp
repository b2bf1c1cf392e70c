#include "tools/lights/night_schedule.h"

#include <algorithm>
#include <array>

#include "tools/lights/hours_words.h"
#include "tools/random.h"

namespace nightcity::lights {
namespace {

uint second_of(int minute) {
  return night_begin_s + 60 * static_cast<uint>(minute);
}

/// Parses "23:00" as minutes after 17:00. Empty for other texts.
std::optional<int> clock_minute(std::string_view text) {
  const auto clock = take_clock(text);
  if (!clock || !text.empty()) return std::nullopt;
  return minute_of(*clock / 60 % 24, *clock % 60);
}

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
