// The heights of a bridge's deck along its way: a string that is pulled taut over the ground and
// over the clear heights of what it crosses, which are rounded as crests of roads are.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace nightcity::bridges {

/// The limits that a deck keeps to.
struct DeckRules {
  double max_gradient = 0.08;  // rise over run
  double crest_radius_m = 250;
};

/// A stretch of the way that the deck's surface has to lie above. Heights in metres.
struct Clearance {
  double from_m, to_m;  // along the way
  double height_m;      // wanted
  double least_m;       // below this nothing passes, and there is no bridge
};

/// The way that a deck takes. `ground_m`: the ground below places that lie evenly along it, both
/// ends among them; none where there is no ground. An end without a height is free: the deck goes
/// on level beyond it.
struct DeckCourse {
  double length_m = 0;
  std::vector<std::optional<double>> ground_m;
  std::optional<double> first_m, last_m;
  std::vector<Clearance> clearances;
};

struct DeckProfile {
  std::vector<double> heights_m;  // as the course's places
  bool is_low = false;            // somewhere lower than wanted, as the gradient allows no more
};

/// Returns the profile: the least concave one above ground and clearances, as far as the gradient
/// allows. None, with `reason`, where it would be steeper, or too low for what passes below.
std::optional<DeckProfile> find_profile(const DeckCourse& course, const DeckRules& rules,
                                        std::string& reason);

}  // namespace nightcity::bridges
