// Where windows sit: rectangles on the walls of one building, aligned over whole facades.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/lights/building_use.h"

namespace nightcity {

/// lobby: of hotels and offices, on the ground floor. hall: of a works.
enum class WindowKind : std::uint8_t { room, shop, stairs, hall, lobby };

struct WindowPlace {
  glm::dvec3 centre{0};  // on the wall's plane; E, N, H, m
  glm::dvec3 normal{0};  // unit, outwards
  glm::dvec3 along{0};   // unit, horizontal: cross(up, normal)
  double half_width = 0, half_height = 0;
  std::uint16_t facade = 0, storey = 0, bay = 0, bays = 0;  // bays: of the whole facade
  WindowKind kind = WindowKind::room;
  bool modelled = false;  // a bldg:Window of the model, not a rule
};

struct FacadeReport {
  std::size_t storeys_from_attribute = 0, storeys_from_height = 0;  // buildings
};

/// Coordinates E, N, H in metres. Facades are coplanar walls (2 degrees, 5 cm) side by side; their bays are
/// spread evenly, their storeys are the building's. A window lies wholly inside its wall, away from its edges
/// and holes. Where the model has windows of its own (LoD3), those and no others. `seed` varies window sizes
/// between buildings.
std::vector<WindowPlace> lay_windows(const CityObject& building, BuildingUse use,
                                     std::uint64_t seed, FacadeReport& report);

}  // namespace nightcity
