#include "tools/bake/city/building_uses.h"

#include <memory>

#include "tools/lights/osm_uses.h"

namespace nightcity::bake {

lights::UseAt make_use_finder(const City& city) {
  if (city.map().buildings.empty() || !city.frame().has_lon_lat()) return {};
  const auto uses = std::make_shared<const lights::OsmUses>(city.map().buildings, city.to_frame());
  return [uses](const glm::dvec2& place) { return uses->at(place); };
}

}  // namespace nightcity::bake
