// Heights from an Open-Elevation-compatible service: in batches, with a cache and with retries.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nightcity::elevation {

struct ElevationServiceOptions {
  std::string url;  // ".../api/v1/lookup"; http or https
  /// "" = none. Each answer is added to it; one file serves any number of services and runs.
  std::filesystem::path cache;
  std::size_t batch = 100;  // places per request
  int attempts = 6;         // per request, while the service is busy (429, 502, 503, 504)
  /// Doubled after each attempt, unless the service's Retry-After says more.
  std::chrono::milliseconds first_wait{1000};
  std::chrono::seconds max_wait{60};
  std::function<void(std::size_t done, std::size_t total)> progress;
};

struct ElevationAnswers {
  std::vector<std::optional<double>> heights;  // m in the service's datum; parallel to the places
  std::size_t requests = 0, retries = 0, from_cache = 0;
  std::size_t zeros_refused = 0;  // 0 m that meant "no data"
};

/// Asks for the heights of `lon_lat` (WGS 84 degrees). Such services answer exactly 0 where they
/// have no data: a zero is believed only near sea level (the median of the other answers is within
/// 10 m of 0), and never when all answers are zero. Throws Error when the service cannot be
/// reached, stays busy, or answers nonsense; its answers until then are in the cache.
ElevationAnswers ask_elevations(std::span<const glm::dvec2> lon_lat,
                                const ElevationServiceOptions& options);

}  // namespace nightcity::elevation
