#include "tools/bake/city/obstacles.h"

namespace nightcity::bake {

place::InsideBuilding find_obstacles(const City& city) {
  return [&city, inside = city.inside_footprint()](const glm::dvec2& place) {
    return (inside && inside(place)) || city.bridges().decks().covers(place);
  };
}

}  // namespace nightcity::bake
