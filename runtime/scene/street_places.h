// Places on streets, of which a scene knows the centrelines.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "runtime/scene/lit_part.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// A place (x, z) on a street, and the street's direction there, of unit length; 0 on a square.
struct StreetPlace {
  glm::dvec2 at, along;
};

double find_length_of(const std::vector<glm::dvec2>& line);

/// Adds places every `step_m` along a line, half a step from its ends.
void add_places(const std::vector<glm::dvec2>& line, double step_m,
                std::vector<StreetPlace>& places);

/// Returns places along the streets within a part of the scene, about `count` of them and at most
/// twice as many, in an order that the scene alone decides: along the centrelines of named streets,
/// or, where no name is known there, beside the ways of vehicles, half a lane to the left and to
/// the right so that these pass by.
std::vector<StreetPlace> list_street_places(const RenderScene& scene, const LitPart& part,
                                            std::size_t count);

}  // namespace nightcity::scene
