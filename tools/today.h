// The day by which dates in files are judged.
#pragma once

#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace nightcity {

/// Returns the day of the environment's SOURCE_DATE_EPOCH
/// (https://reproducible-builds.org/specs/source-date-epoch), if it is set, otherwise this one.
inline std::chrono::sys_days today() {
  using namespace std::chrono;
  constexpr std::int64_t farthest_s = 1'000'000'000'000;
  if (const char* text = std::getenv("SOURCE_DATE_EPOCH")) {
    std::int64_t value = 0;
    const char* end = text + std::strlen(text);
    if (const auto [stop, error] = std::from_chars(text, end, value);
        error == std::errc() && stop == end && value > -farthest_s && value < farthest_s)
      return floor<days>(sys_seconds(seconds(value)));
  }
  return floor<days>(system_clock::now());
}

}  // namespace nightcity
