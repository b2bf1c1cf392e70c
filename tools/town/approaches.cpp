#include "tools/town/approaches.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "tools/random.h"

namespace nightcity::town {
namespace {

// From the kerb of the junction, m: crossings lie beyond the arcs of its corners, and vehicles stop
// before them; where nobody crosses they give way at the kerb.
constexpr double crossing_from_m = 8.5, stop_from_m = 12, give_way_from_m = 1.5;

bool is_main(StreetClass street) {
  return street == StreetClass::primary || street == StreetClass::secondary ||
         street == StreetClass::tertiary;
}

bool has_signals(StreetClass street) {
  return street == StreetClass::primary || street == StreetClass::secondary;
}

// Returns the street that crosses one of an axis at a node.
StreetClass cross_street(const StreetPlan& streets, int axis, int i, int j) {
  return axis == 0 ? streets.column_street(i, std::min(j, streets.rows() - 1))
                   : streets.row_street(std::min(i, streets.columns() - 1), j);
}

}  // namespace

bool is_driven(StreetClass street) {
  return street != StreetClass::pedestrian && street != StreetClass::footway;
}

std::vector<Approach> find_approaches(const StreetPlan& streets, const Stretch& s,
                                      std::uint64_t seed) {
  std::vector<Approach> found;
  if (s.axis == 2 || !is_driven(s.street)) return found;
  using Kind = Approach::Kind;
  const glm::dvec2 along = glm::normalize(s.to - s.from);
  for (const bool at_end : {false, true}) {
    const int i = s.i + (at_end && s.axis == 0), j = s.j + (at_end && s.axis == 1);
    const StreetClass across = cross_street(streets, s.axis, i, j);
    const auto add = [&](int number, double from_kerb_m, Kind kind) {
      const glm::dvec2 at = at_end ? s.to - along * from_kerb_m : s.from + along * from_kerb_m;
      found.push_back({kind, at, at_end, 2 * at_end + number});
    };
    Random random{static_cast<std::int64_t>(seed), 14, s.axis, s.i, s.j, at_end};
    if (has_signals(s.street) && has_signals(across)) {
      add(0, crossing_from_m, Kind::crossing_at_signals);
      add(1, stop_from_m, Kind::signals);
    } else if (is_main(s.street)) {
      if (random.chance(0.5)) add(0, crossing_from_m, Kind::zebra);
    } else if (is_main(across)) {
      add(0, give_way_from_m, Kind::give_way);
      if (random.chance(0.5)) add(1, crossing_from_m, Kind::unmarked_crossing);
    }
  }
  std::sort(found.begin(), found.end(), [&](const Approach& a, const Approach& b) {
    return glm::dot(a.at, along) < glm::dot(b.at, along);
  });
  return found;
}

}  // namespace nightcity::town
