// Lowered kerbs: where people cross a street, the ground beside it comes down to the carriageway.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::ground_cover {

class Cover;
struct Box;

/// The height of a kerb at a crossing that no tag says otherwise of, m: at most 3 cm where all
/// people cross at one place (DIN 18040-3, 5.3.2).
constexpr double lowered_kerb_m = 0.03;
/// The greatest slope of a ramp along which people go (DIN 18040-3: 6 %).
constexpr double max_ramp_slope = 0.06;
/// The kerb comes down so far beside a crossing, m: the length of a sloped kerbstone.
constexpr double flare_m = 1.0;

/// A plane piece of a ramp. Within its ring the ground lies lower by a linear function of the
/// place.
struct RampFacet {
  std::vector<glm::dvec2> ring;  // E, N of the city's frame, m
  glm::dvec2 origin{0}, gradient{0};
  double at_origin_m = 0;
  double find_lowering_m(const glm::dvec2& place) const {
    return at_origin_m + glm::dot(gradient, place - origin);
  }
};

/// Returns the facets of the ramp on one side of a street. `kerb`: where the crossing meets it;
/// `along`: the street's direction; `outward`: from the street; both of length 1. The ground is
/// lower by `drop_m` along crossing_m of the kerb, and comes up over flare_m beside it and by
/// max_ramp_slope behind it.
std::vector<RampFacet> make_ramp(const glm::dvec2& kerb, const glm::dvec2& along,
                                 const glm::dvec2& outward, double drop_m);

/// Adds ramps to `cover` on both sides of kerbed streets at each `highway=crossing` and at each
/// node of a crossing's way, as far as they lie in `bounds`, but for those in the middle of a
/// junction, in tunnels and on bridges. `kerb` says how high the kerb is: `raised` leaves it,
/// `flush` or `no` takes it away.
void add_kerb_ramps(std::span<const osm::OsmWay> ways, std::span<const osm::OsmPoint> crossings,
                    const place::LonLatToFrame& to_frame, const Box& bounds, Cover& cover);

}  // namespace nightcity::ground_cover
