// When a light is lit during one night, and how city.lights stores it: equal nights once.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "formats/night.h"

namespace nightcity::lights {

constexpr int night_minutes = (night_end_s - night_begin_s) / 60;  // from 17:00 to 07:00
constexpr int night_begin_hour = 12 + night_begin_s / 3600;        // on the clock: 17

/// Returns the minutes after 17:00 of a clock time, e.g. (23, 30) or (3, 0).
constexpr int minute_of(int hour, int minute) {
  return ((hour + 24 - night_begin_hour) % 24) * 60 + minute;
}

/// The half of the Earth that a light stands on. Our night is a long one, with its sunset before
/// 17:00: one of December in the north, of June in the south.
enum class Half : std::uint8_t { north, south };

constexpr Half half_at(double latitude) {
  return latitude < 0 ? Half::south : Half::north;
}

/// Up to four spans of light, in minutes after 17:00, ascending and apart. A span with on == off
/// is not used.
struct NightSchedule {
  std::array<std::uint16_t, 4> on{}, off{};

  bool lit_at(int minute) const;
  bool never() const;
  auto operator<=>(const NightSchedule&) const = default;
};

/// Returns a night that is lit except for the minutes from `off` to `on`, e.g. of a street whose
/// lamps are switched off at 1:00 and on again at 4:30.
NightSchedule dark_between(int off, int on);

/// Parses "23:00-05:00" as minutes after 17:00. Empty for other texts, for times outside 17:00 to
/// 07:00 and for an end that is not after its beginning.
struct NightSpan {
  int from, to;
};
std::optional<NightSpan> parse_night_span(std::string_view text);

/// The schedules of a light file under construction, in the order in which they are added. Equal
/// ones are stored once, unless `max_known` others came in between: a city has hundreds of
/// thousands, and memory must not grow with it.
class ScheduleTable {
 public:
  /// Stores a schedule, given as its switch times in seconds since noon, and returns its number:
  /// LightFileWriter::add_schedule.
  using Store = std::function<std::uint32_t(std::span<const uint> switches)>;
  explicit ScheduleTable(Store store, std::size_t max_known = 100'000)
      : store_(std::move(store)), max_known_(max_known) {}

  /// Returns the number of a schedule, which must not be never().
  std::uint32_t add(const NightSchedule& schedule);
  /// Returns the number of stored schedules.
  std::size_t size() const { return size_; }

 private:
  struct Hash {
    std::size_t operator()(const NightSchedule& schedule) const;
  };
  Store store_;
  std::size_t max_known_, size_ = 0;
  std::unordered_map<NightSchedule, std::uint32_t, Hash> known_;
};

/// Number of full hours of the night, 17:00 to 07:00, at which shares are counted.
constexpr std::size_t night_hours = 15;
/// Number of lights that are lit at each full hour; at 07:00, those that were lit a minute earlier.
using HourCounts = std::array<std::size_t, night_hours>;
void count_hours(const NightSchedule& schedule, HourCounts& counts);
/// Returns the hour of such a count: 17, 18, ..., 0, ... 7.
constexpr int clock_hour(std::size_t index) {
  return static_cast<int>((night_begin_hour + index) % 24);
}

}  // namespace nightcity::lights
