// Plans of floodlights: where luminaires stand, how they aim, and the points that they are to
// light.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/lights/photometry.h"
#include "tools/lights/place_lamps.h"
#include "tools/map_lights/box_around.h"
#include "tools/map_lights/ground.h"
#include "tools/map_lights/illuminance.h"

namespace nightcity::map_lights {

struct Installation {
  std::string beam;                       // name of the profile
  lights::Photometry profile;             // of one lumen
  std::vector<lights::PlacedLamp> lamps;  // place and aim alone
  std::vector<TargetPoint> points;
};

/// Larger things are left out: nobody floodlights a landscape.
constexpr double max_box_m = 250;

/// Plans masts along both long sides of a pitch, 3 m behind them and at most two mounting heights
/// apart. They are as high as an angle of 25 degrees from the middle line asks for (EN 12193 and
/// FIFA's guide to stadiums: at least 20 to 25 degrees, because of glare), and 8 m at least, which
/// is an assumption. The points are those of the ground within `ring` (E, N). Masts that would
/// stand in a building are not there. Empty where fewer than two masts can stand on the ground.
std::optional<Installation> plan_pitch(const std::vector<glm::dvec2>& ring, const Box& box,
                                       const Ground& ground);

/// Plans floodlights on the ground before one of the four sides of a box (0 to 3), at half of its
/// height from it, aiming at 0.6 of its height: assumptions. Where a building stands in the way
/// they come nearer. The points lie on the wall. Empty where there is no room.
std::optional<Installation> plan_wall(const Box& box, int side, double height_m,
                                      const Ground& ground);

/// Plans downlights in a square grid of `mounting_m` over the ground within `ring`.
std::optional<Installation> plan_downlights(const std::vector<glm::dvec2>& ring, const Box& box,
                                            double mounting_m, const Ground& ground);

}  // namespace nightcity::map_lights
