// Heights from an Open-Elevation-compatible service: batched, remembered, patient.
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

namespace nightcity {

struct ElevationServiceOptions {
  std::string url;  // ".../api/v1/lookup"; http or https
  std::filesystem::path
      cache;                // "" = none; grows by each answer, for any number of services and runs
  std::size_t batch = 100;  // places a request
  int attempts = 6;         // of one request, while the service is busy (429, 502, 503, 504)
  std::chrono::milliseconds first_wait{
      1000};  // doubled after each; the service's Retry-After counts too
  std::chrono::seconds longest_wait{60};
  std::function<void(std::size_t done, std::size_t total)> progress;
};

struct ElevationAnswers {
  std::vector<std::optional<double>>
      heights;  // m above the service's own zero; parallel to the places
  std::size_t requests = 0, retries = 0, from_cache = 0;
  std::size_t zeros_refused = 0;  // 0 m that meant "no data"
};

/// Asks for the heights of `lon_lat` (WGS 84 degrees). Such services answer exactly 0 where they have no
/// data: a zero is believed only where the places about it lie near the sea's level (the median of the other
/// answers is within 10 m of 0), and never when all answers are zero. Throws Error when the service cannot be
/// reached, stays busy, or answers nonsense; what it has told until then is in the cache.
ElevationAnswers ask_elevations(std::span<const glm::dvec2> lon_lat,
                                const ElevationServiceOptions& options);

}  // namespace nightcity
