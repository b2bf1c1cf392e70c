// Places where a pedestrian can stand, and the views from there.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/scene/camera.h"

namespace nightcity::scene {

/// Directions that are looked in, all round.
constexpr int sight_count = 32;

struct Standpoint {
  glm::dvec3 eye;
  std::array<double, sight_count> open;  // free way in each direction, m
};

/// Returns a direction, level, of unit length: 0 is east, a quarter of them on is south.
glm::dvec3 direction_of(int sight);
/// Returns the number of the direction nearest to a vector.
int find_sight(const glm::dvec3& direction);

/// Returns the standpoint at a place (x, z) on the ground under the open sky and clear of walls;
/// nothing where the topmost surface is none to stand on, such as a roof.
std::optional<Standpoint> find_standpoint(const RenderScene& scene, double x, double z);

/// Rates a view by what makes a street: a long way ahead and some behind, walls to both sides.
double rate_view(const Standpoint& from, int sight);

/// Rates a view by the light that lies along it: lights within a cone ahead, near ones more.
double rate_lights(const RenderScene& scene, const Standpoint& from, int sight);

/// Returns a pedestrian's view in a level direction of unit length.
CameraPose look_from(const Standpoint& from, const glm::dvec3& ahead);

}  // namespace nightcity::scene
