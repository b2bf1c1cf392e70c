#include "tools/survey/box.h"

#include <cmath>
#include <glm/common.hpp>

namespace nightcity::survey {
namespace {

// Returns the whole turns, in degrees, by which `longitude` is to be lowered to come next to
// another.
double turns_between(double other, double longitude) {
  return 360 * std::round((longitude - other) / 360);
}

}  // namespace

void Box::add(glm::dvec2 lon_lat) {
  if (!std::isfinite(lon_lat.x) || !std::isfinite(lon_lat.y)) return;
  if (!empty()) lon_lat.x -= turns_between(least.x, lon_lat.x);
  least = glm::min(least, lon_lat);
  greatest = glm::max(greatest, lon_lat);
}

bool Box::is_near(const Box& other, double degrees) const {
  if (empty() || other.empty()) return false;
  const double middle = (other.least.x + other.greatest.x) / 2;
  const double turns = turns_between((least.x + greatest.x) / 2, middle);
  return least.x - degrees <= other.greatest.x - turns &&
         other.least.x - turns - degrees <= greatest.x && least.y - degrees <= other.greatest.y &&
         other.least.y - degrees <= greatest.y;
}

}  // namespace nightcity::survey
