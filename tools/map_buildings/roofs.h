// The walls and roof over an outline.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/map_buildings/building_tags.h"

namespace nightcity::map_buildings {

/// An area of the map in a plane, in metres: x east, y north. Rings are open; the outer one runs
/// anticlockwise, holes clockwise.
struct Outline {
  std::vector<glm::dvec2> outer;
  std::vector<std::vector<glm::dvec2>> holes;
};

/// Makes the roof as high as its slope says over the outline (`slope_degrees`), within the sizes,
/// and a dome of which nothing says its height half as high as the outline is wide.
void fit_slope(const Outline& outline, BuildingSizes& sizes);

/// Returns a closed shell that faces outward: floor, walls, roof. Where the roof's shape does not
/// fit the outline (a gable or the like over anything that its lines cut more than twice, hipped
/// roofs over anything but four corners, a pyramid or dome whose top would not see every edge, and
/// all but a skillion over holes) it is flat at its top, and `made_flat` is set.
std::vector<city::Polygon> make_shell(const Outline& outline, const BuildingSizes& sizes,
                                      bool& made_flat);

}  // namespace nightcity::map_buildings
