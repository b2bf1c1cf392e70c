// Places windows: rectangles on the walls of one building, aligned over whole facades.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/lights/building_use.h"

namespace nightcity::lights {

/// lobby: of hotels and offices, on the ground floor. hall: of an industrial building.
enum class WindowKind : std::uint8_t { room, shop, stairs, hall, lobby };

struct WindowPlace {
  glm::dvec3 centre{0};  // on the wall's plane; E, N, H, m
  glm::dvec3 normal{0};  // unit, outwards
  glm::dvec3 along{0};   // unit, horizontal: cross(up, normal)
  double half_width = 0, half_height = 0;
  std::uint16_t facade = 0, storey = 0, bay = 0, bays = 0;  // bays: of the whole facade
  WindowKind kind = WindowKind::room;
  bool modelled = false;  // a bldg:Window of the model, not placed by rule
};

/// Windows of one building: the largest office buildings have some 30,000.
constexpr std::size_t default_max_windows = 100'000;

struct FacadeReport {
  std::size_t storeys_from_attribute = 0, storeys_from_height = 0;  // numbers of buildings
  std::size_t too_many = 0;  // buildings without windows because they would have too many
};

/// Returns the windows of a building; coordinates E, N, H in metres. A facade is a row of
/// coplanar walls (within 2 degrees and 5 cm) side by side. Its bays are spread evenly; its
/// storeys are those of the building. A window lies wholly inside its wall, away from edges and
/// holes. If the model has windows of its own (LoD3), only those are returned. `seed` varies
/// window sizes between buildings. A building to which the rules would give more than
/// `max_windows` gets none and is counted: one of 50 km would have millions.
std::vector<WindowPlace> place_windows(const city::CityObject& building, BuildingUse use,
                                       std::uint64_t seed, FacadeReport& report,
                                       std::size_t max_windows = default_max_windows);

}  // namespace nightcity::lights
