#include "tools/map_buildings/roofs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tools/map_buildings/rectangle.h"
#include "tools/map_buildings/roof_shapes.h"
#include "tools/map_buildings/shell.h"

namespace nightcity::map_buildings {
namespace {

// The way that roof:direction says, else across the longer side.
glm::dvec2 find_fall(const BuildingSizes& sizes, const Rectangle& box) {
  if (!sizes.direction_degrees) return {-box.along.y, box.along.x};
  const double angle = *sizes.direction_degrees * std::numbers::pi / 180;
  return {std::sin(angle), std::cos(angle)};
}

// A ridge along one side of the box. The (longer) slope to its right falls the way that
// roof:direction says.
struct Ridge {
  glm::dvec2 along;
  double width_m;  // of the box across it
};

bool is_row(RoofShape shape) {
  return shape == RoofShape::sawtooth || shape == RoofShape::gabled_row;
}

Ridge find_ridge(const BuildingSizes& sizes, const Rectangle& box) {
  const glm::dvec2 across(-box.along.y, box.along.x), fall = find_fall(sizes, box);
  const bool falls_along =
      std::abs(glm::dot(fall, box.along)) > std::abs(glm::dot(fall, across)) + 1e-9;
  // The ridges of a row follow each other along the longer side.
  const bool row = is_row(sizes.roof) && !sizes.direction_degrees;
  const bool turned = sizes.across.value_or(row || falls_along);
  glm::dvec2 side = turned ? box.along : across;
  if (glm::dot(side, fall) < 0) side = -side;
  return {{-side.y, side.x}, turned ? box.length : box.width};
}

// The outline reaches from `low` to `high` along a direction, m.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Extent find_extent(const Outline& outline, const glm::dvec2& along) {
  Extent extent;
  for (const glm::dvec2& p : outline.outer) {
    extent.low = std::min(extent.low, glm::dot(p, along));
    extent.high = std::max(extent.high, glm::dot(p, along));
  }
  return extent;
}

// The upper edge of a skillion runs as a ridge would.
glm::dvec2 find_skillion_fall(const BuildingSizes& sizes, const Rectangle& box) {
  const bool is_across = sizes.across.value_or(false) && !sizes.direction_degrees;
  return is_across ? box.along : find_fall(sizes, box);
}

// A plane that falls from the top to the eaves.
void add_skillion(Shell& shell, const Outline& outline, const BuildingSizes& sizes,
                  const Rectangle& box) {
  const glm::dvec2 fall = find_skillion_fall(sizes, box);
  const auto [low, high] = find_extent(outline, fall);
  const double slope = (sizes.top_m - sizes.eaves_m) / std::max(high - low, 1e-6);
  shell.add_plane([&, low = low](const glm::dvec2& p) {
    return sizes.top_m - slope * (glm::dot(p, fall) - low);
  });
}

}  // namespace

void fit_slope(const Outline& outline, BuildingSizes& sizes) {
  const Rectangle box = find_rectangle(outline.outer);
  if (sizes.roof == RoofShape::dome && !sizes.rise_is_said) return set_rise(sizes, box.width / 2);
  if (!sizes.slope_degrees || sizes.roof == RoofShape::flat) return;
  double run = box.width / 2;
  switch (sizes.roof) {
    case RoofShape::gabled:
    case RoofShape::gambrel:
    case RoofShape::round:
    case RoofShape::butterfly:
      run = find_ridge(sizes, box).width_m / 2;
      break;
    case RoofShape::saltbox:
      run = find_ridge(sizes, box).width_m * 2 / 3;
      break;
    case RoofShape::double_saltbox:
      run = find_ridge(sizes, box).width_m / 3;
      break;
    case RoofShape::quadruple_saltbox:
      run = box.width / 3;
      break;
    case RoofShape::sawtooth:
      run = row_step_m;
      break;
    case RoofShape::gabled_row:
      run = row_step_m / 2;
      break;
    case RoofShape::skillion: {
      const Extent extent = find_extent(outline, find_skillion_fall(sizes, box));
      run = extent.high - extent.low;
      break;
    }
    default:
      break;
  }
  set_rise(sizes, run * std::tan(*sizes.slope_degrees * std::numbers::pi / 180));
}

namespace {

// Returns false, and adds nothing, where the shape does not fit the outline.
bool add_roof(Shell& shell, const Outline& outline, const BuildingSizes& sizes) {
  const Rectangle box = find_rectangle(outline.outer);
  if (sizes.roof == RoofShape::skillion) {
    add_skillion(shell, outline, sizes, box);
    return true;
  }
  if (!outline.holes.empty()) return false;
  const Ridge ridge = find_ridge(sizes, box);
  const auto add = [&](auto make_profile) {
    return add_profile(shell, box.middle, ridge.along, make_profile(sizes, ridge.width_m));
  };
  switch (sizes.roof) {
    case RoofShape::gabled:
      return add(make_gable);
    case RoofShape::gambrel:
      return add(make_gambrel);
    case RoofShape::round:
      return add(make_round);
    case RoofShape::saltbox:
      return add(make_saltbox);
    case RoofShape::butterfly:
      return add(make_butterfly);
    case RoofShape::double_saltbox:
      return add(make_double_saltbox);
    case RoofShape::sawtooth:
      return add(make_sawtooth);
    case RoofShape::gabled_row:
      return add(make_gabled_row);
    case RoofShape::side_hipped:
      return add_side_hip(shell, find_fall(sizes, box));
    case RoofShape::side_half_hipped:
      return add_side_half_hip(shell, find_fall(sizes, box));
    case RoofShape::gablet:
      return add_gablet(shell);
    case RoofShape::quadruple_saltbox:
      return add_quadruple_saltbox(shell);
    case RoofShape::crosspitched:
      return add_crossed_gables(shell);
    case RoofShape::hipped:
      return add_hip(shell);
    case RoofShape::half_hipped:
      return add_half_hip(shell);
    case RoofShape::mansard:
      return add_mansard(shell);
    case RoofShape::pyramidal:
      return add_pyramid(shell);
    case RoofShape::dome:
      return add_dome(shell);
    case RoofShape::onion:
      return add_onion(shell);
    case RoofShape::flat:
    case RoofShape::skillion:
      break;
  }
  return false;
}

}  // namespace

std::vector<city::Polygon> make_shell(const Outline& outline, const BuildingSizes& sizes,
                                      bool& made_flat) {
  Shell shell(outline, sizes);
  const bool done = sizes.roof != RoofShape::flat && add_roof(shell, outline, sizes);
  made_flat = !done && sizes.roof != RoofShape::flat;
  if (!done) shell.add_plane([&](const glm::dvec2&) { return sizes.top_m; });
  return shell.take();
}

}  // namespace nightcity::map_buildings
