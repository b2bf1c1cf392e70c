// Finds places for lamp posts along a street: behind the kerb, clear of buildings and of other
// carriageways.
#pragma once

#include <optional>
#include <vector>

#include "tools/lights/place_lamps.h"
#include "tools/place/place_grid.h"
#include "tools/streets/street_network.h"

namespace nightcity::layout {

struct PostSite {
  glm::dvec3 foot{0};
  double along_m = 0;   // on the street
  double offset_m = 0;  // from the centreline
  int side = 0;         // +1 left of the street's direction, -1 right, 0 hung over the middle
  bool moved = false;   // moved towards the kerb because of a building
};

enum class SiteFault { outside_model, building, carriageway };

class PostSites {
 public:
  /// All arguments must outlive this object. `unlit` roads count as carriageways too.
  PostSites(const streets::StreetNetwork& network, const std::vector<const osm::OsmWay*>& unlit,
            const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
            const place::InsideBuilding& inside);

  /// Returns the place beside a street at `along_m`. Where a building stands too near, the place
  /// moves towards the kerb. Empty, with the reason in `fault`, where there is no room.
  std::optional<PostSite> beside(std::size_t street, double along_m, int side,
                                 SiteFault& fault) const;
  /// Returns the place over the centreline, if no building is above it.
  std::optional<PostSite> above(std::size_t street, double along_m, SiteFault& fault) const;
  /// Returns whether another carriageway lies within `clearance_m` of p.
  bool near_other_carriageway(std::size_t street, const glm::dvec2& p, double clearance_m) const;

 private:
  void add_carriageway(const std::vector<glm::dvec2>& line, double width_m);
  bool is_in_carriageway(const streets::Street& street, const glm::dvec2& p) const;
  bool clear_of_buildings(const glm::dvec2& p) const;

  const streets::StreetNetwork& network_;
  const place::HeightAt& height_at_;
  const place::InsideBuilding& inside_;
  place::PlaceGrid carriageways_{20};  // points of the centrelines, two metres apart
  std::vector<double> half_widths_m_;  // by carriageway; the streets first
  double widest_half_m_ = 0;
};

}  // namespace nightcity::layout
