// The trees of a city model: plants that stand alone, and covers of plants that are woods.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/trees/leaf_habit.h"

namespace nightcity::trees {

/// Says what becomes of a city model's vegetation: plants that stand alone become trees and the
/// rest surfaces, all of it becomes the surfaces that the model has, or it is left out.
enum class Vegetation : std::uint8_t { trees, surfaces, none };

/// A lower plant is no tree, m: an assumption.
constexpr double min_tree_m = 1;
/// A cover of plants (PlantCover) that is lower is no wood, m: an assumption, below which hedges and
/// scrub stand.
constexpr double min_wood_m = 3;
/// Larger covers stay surfaces: a wood is strewn over the squares of a grid, and asks its outline
/// for each.
constexpr double max_wood_width_m = 3000;
constexpr std::size_t max_wood_corners = 20'000;

struct ModelTree {
  std::string id, class_name, function;  // as city::CityObject's
  glm::dvec2 place{0};                   // E, N of the city's frame, m
  /// Height of the foot in that frame, m; absent where the model has no heights.
  std::optional<double> foot_m;
  /// Absent where neither attributes nor surfaces say.
  std::optional<double> height_m, crown_m, trunk_m;  // crown and trunk: diameters
  LeafHabit habit;
  bool is_shrub = false;  // has leaves down to the ground
  int odd_sizes = 0;      // as city::Plant's
  /// The plan of a cover of plants, in which trees stand as in a wood of the map; empty: one tree.
  std::vector<std::vector<glm::dvec2>> outlines;
};

/// Why an object is no tree.
enum class NoTree : std::uint8_t { is_one, no_plant, nowhere, low, wide };

/// Returns the tree that an object in the city's frame is (CityGML's and CityJSON's
/// SolitaryVegetationObject): it stands at its point, else in the middle of its surfaces, and what
/// its attributes do not say about its size its surfaces do. Otherwise sets `why` it is none: low
/// plants, and what is too wide to be one tree. A PlantCover that is high enough is a wood: its plan
/// is that of the surfaces that face upward.
std::optional<ModelTree> find_model_tree(const city::CityObject& object, NoTree* why = nullptr);

}  // namespace nightcity::trees
