#include "tools/map_lights/installation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tools/in_ring.h"
#include "tools/map_lights/beams.h"

namespace nightcity::map_lights {
namespace {

constexpr double behind_m = 3, min_mast_m = 8, max_mast_m = 30;
constexpr double floodlight_height_m = 0.3;  // of a floodlight that stands on the ground
constexpr double aimed_at = 0.6;             // of a wall's height

// Calls visit(u, v) for the middles of the cells of a grid over the box, -1 to 1 along both.
template <class Visit>
void for_each_cell(int columns, int rows, const Visit& visit) {
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) visit((2.0 * i + 1) / columns - 1, (2.0 * j + 1) / rows - 1);
}

int count_cells(double length_m, double step_m, int least) {
  return std::clamp(static_cast<int>(std::ceil(length_m / step_m)), least, 60);
}

std::vector<TargetPoint> find_ground_points(const std::vector<glm::dvec2>& ring, const Box& box,
                                            double step_m, const Ground& ground) {
  std::vector<TargetPoint> points;
  for_each_cell(count_cells(box.length_m, step_m, 10), count_cells(box.width_m, step_m, 10),
                [&](double u, double v) {
                  const glm::dvec2 place = box.at(u, v);
                  if (!in_ring(ring, place)) return;
                  if (const auto height = ground.height_at(place))
                    points.push_back({{place, *height}, {0, 0, 1}});
                });
  return points;
}

std::optional<lights::PlacedLamp> stand_at(const glm::dvec2& place, const Ground& ground) {
  const auto height = ground.height_at(place);
  if (!height || ground.is_inside(place)) return std::nullopt;
  lights::PlacedLamp lamp;
  lamp.foot = {place, *height};
  return lamp;
}

}  // namespace

std::optional<Installation> plan_pitch(const std::vector<glm::dvec2>& ring, const Box& box,
                                       const Ground& ground) {
  const double half_m = box.width_m / 2 + behind_m;
  const double mast_m = std::clamp(half_m * std::tan(glm::radians(25.0)), min_mast_m, max_mast_m);
  // Distributions differ by quarters of a mounting height, so that a city has few.
  const double quarters = std::ceil(4 * 2 * half_m / mast_m - 1e-9);
  Installation plan;
  plan.beam = "area floodlight " + std::to_string(static_cast<int>(quarters));
  plan.profile = make_area_floodlight(quarters / 4);
  const int masts = std::max(2, static_cast<int>(std::ceil(box.length_m / (2 * mast_m))));
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < masts; ++i) {
      const glm::dvec2 place =
          box.at((2.0 * i + 1) / masts - 1, 0) + box.across() * (side * half_m);
      auto lamp = stand_at(place, ground);
      if (!lamp) continue;
      lamp->mounting_height_m = mast_m;
      lamp->aim = box.across() * -side;
      plan.lamps.push_back(*lamp);
    }
  plan.points = find_ground_points(ring, box, 5, ground);
  if (plan.lamps.size() < 2 || plan.points.empty()) return std::nullopt;
  return plan;
}

std::optional<Installation> plan_wall(const Box& box, int side, double height_m,
                                      const Ground& ground) {
  const double sign = side % 2 == 0 ? 1 : -1;
  const bool is_end = side >= 2;
  const glm::dvec2 normal = (is_end ? box.along : box.across()) * sign;
  const glm::dvec2 along(-normal.y, normal.x);
  const double width_m = is_end ? box.width_m : box.length_m;
  const glm::dvec2 middle = is_end ? box.at(sign, 0) : box.at(0, sign);
  const auto foot = ground.height_at(middle + normal);
  if (!foot || !(width_m > 0)) return std::nullopt;

  Installation plan{"spotlight", make_spotlight(), {}, {}};
  const int count =
      std::clamp(static_cast<int>(std::ceil(width_m / std::max(height_m, 6.0))), 1, 20);
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 at = middle + along * (width_m * ((i + 0.5) / count - 0.5));
    for (double away = std::clamp(height_m / 2, 2.0, 15.0); away >= 1; away *= 0.75) {
      auto lamp = stand_at(at + normal * away, ground);
      if (!lamp) continue;
      lamp->mounting_height_m = floodlight_height_m;
      lamp->aim = -normal;
      const double up_m = *foot + aimed_at * height_m - (lamp->foot.z + floodlight_height_m);
      lamp->tilt_degrees = 90 + glm::degrees(std::atan2(up_m, away));
      plan.lamps.push_back(*lamp);
      break;
    }
  }
  if (plan.lamps.empty()) return std::nullopt;
  for_each_cell(count_cells(width_m, 2, 10), 10, [&](double u, double v) {
    plan.points.push_back(
        {{middle + along * (u * width_m / 2), *foot + (v + 1) / 2 * height_m}, {normal, 0}});
  });
  return plan;
}

std::optional<Installation> plan_downlights(const std::vector<glm::dvec2>& ring, const Box& box,
                                            double mounting_m, const Ground& ground) {
  Installation plan{"downlight", make_downlight(), {}, {}};
  const auto count = [&](double length_m) {
    return std::clamp(static_cast<int>(std::lround(length_m / mounting_m)), 1, 40);
  };
  for_each_cell(count(box.length_m), count(box.width_m), [&](double u, double v) {
    const glm::dvec2 place = box.at(u, v);
    const auto height = ground.height_at(place);
    if (!height || !in_ring(ring, place)) return;
    // A building that reaches down to the light is no canopy.
    if (const auto solid = ground.find_solid(place);
        solid && solid->low_m < *height + mounting_m && solid->high_m > *height + mounting_m)
      return;
    lights::PlacedLamp lamp;
    lamp.foot = {place, *height};
    lamp.mounting_height_m = mounting_m;
    lamp.aim = box.along;
    lamp.hung = true;
    plan.lamps.push_back(lamp);
  });
  plan.points = find_ground_points(ring, box, 2, ground);
  if (plan.lamps.empty() || plan.points.empty()) return std::nullopt;
  return plan;
}

}  // namespace nightcity::map_lights
