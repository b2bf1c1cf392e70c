// Appends the lamps of a layout to the set of mapped lamps.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include "tools/layout/layout.h"
#include "tools/layout/layout_design.h"
#include "tools/layout/post_sites.h"
#include "tools/lights/place_lamps.h"
#include "tools/place/place_grid.h"
#include "tools/streets/street_network.h"

namespace nightcity::layout {

class LampAppender {
 public:
  /// `set` holds the mapped lamps. Both arguments must outlive this object.
  LampAppender(const lights::LampOptions& lamps, lights::LampSet& set);

  /// Gives all lamps of an OSM way its hours.
  void set_hours(std::int64_t way_id, const lights::NightSchedule& hours);

  /// Returns the number, in the set, of the luminaire profile of a class of road; adds it if it is
  /// new. `is_hung`: over the middle of the street.
  std::uint32_t profile_for(const lights::RoadLighting& road, bool is_hung);

  /// Appends a lamp of the street with the number `number`. Its identity follows from its way and
  /// its place along the way.
  void append(std::size_t number, const streets::Street& street, const LampDesign& design,
              const PostSite& site);

  /// Returns whether any lamp stands within `radius` metres of p.
  bool any_near(const glm::dvec2& p, double radius) const;
  /// Returns whether a lamp that is not of the street `number` stands within `radius` metres of p
  /// and points towards it.
  bool lit_by_another(std::size_t number, const glm::dvec2& p, double radius) const;

  /// Returns the number in the set of the first appended lamp.
  std::size_t first() const { return first_; }
  /// Returns the street of each appended lamp.
  const std::vector<std::size_t>& street_of_lamp() const { return street_of_lamp_; }

  /// Adds the sources of the appended lamps' values to set.sources.
  void count_sources() const;

 private:
  const lights::LuminaireChoice* find_measured(const lights::RoadLighting& road,
                                               bool is_hung) const;
  std::uint32_t make_unused_id(const streets::Street::Place& place, int side);

  const lights::LampOptions& options_;
  lights::LampSet& set_;
  const std::size_t first_;
  std::map<std::int64_t, lights::NightSchedule> hours_of_way_;
  std::map<std::string, std::uint32_t> profiles_;
  place::PlaceGrid placed_{15};
  std::unordered_set<std::uint32_t> ids_;
  std::vector<std::size_t> street_of_lamp_;
};

}  // namespace nightcity::layout
