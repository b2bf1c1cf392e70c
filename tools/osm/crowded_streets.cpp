#include "tools/osm/crowded_streets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "tools/osm/resolution.h"

namespace nightcity::osm {
namespace {

// `lon_lat`: on the globe, so that both numbers have 32 bits.
std::uint64_t to_key(const glm::dvec2& lon_lat) {
  const auto part = [](double degrees) { return static_cast<std::uint32_t>(to_steps(degrees)); };
  return std::uint64_t{part(lon_lat.x)} << 32 | part(lon_lat.y);
}

}  // namespace

std::size_t leave_out_crowded(std::vector<OsmWay>& streets) {
  std::unordered_map<std::uint64_t, std::size_t> visits;
  return std::erase_if(streets, [&](const OsmWay& street) {
    bool is_crowded = false;
    for (const glm::dvec2& p : street.lon_lat)
      is_crowded = ++visits[to_key(p)] > max_streets_at_node || is_crowded;
    if (is_crowded)
      for (const glm::dvec2& p : street.lon_lat) --visits[to_key(p)];
    return is_crowded;
  });
}

}  // namespace nightcity::osm
