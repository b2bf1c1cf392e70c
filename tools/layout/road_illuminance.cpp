#include "tools/layout/road_illuminance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

namespace nightcity::layout {

using std::numbers::pi;

double illuminance(const RoadLuminaire& lamp, const glm::dvec2& point) {
  const glm::dvec2 away = point - lamp.centre;
  const double h = lamp.height_m, square = glm::dot(away, away) + h * h;
  if (!(h > 0)) return 0;
  const double distance = std::sqrt(square);
  double candela_per_lumen = 1 / (4 * pi);
  if (lamp.profile) {
    // C turns from the aim towards cross(axis, aim): to the right of it, seen from above.
    const double along = glm::dot(away, lamp.aim),
                 right = away.x * lamp.aim.y - away.y * lamp.aim.x;
    const double t = glm::radians(lamp.tilt_degrees), c = std::cos(t), s = std::sin(t);
    const double on_axis = (h * c + along * s) / distance;
    candela_per_lumen = lights::intensity_at(*lamp.profile, std::atan2(right, along * c - h * s),
                                             std::acos(std::clamp(on_axis, -1.0, 1.0)));
  }
  return lamp.flux_lm * candela_per_lumen * h / (square * distance);
}

const char* name_of(Arrangement arrangement) {
  constexpr const char* names[] = {"single-sided", "staggered", "opposite", "central"};
  return names[static_cast<int>(arrangement)];
}

int points_across(double width_m) {
  constexpr double lane_m = 3.25;  // of through roads, tools/roads/road_class.cpp
  return 3 * std::max(1, static_cast<int>(std::lround(width_m / lane_m)));
}

FieldSummary row_illuminance(const LampRow& row) {
  constexpr double reach_heights = 30;
  const bool staggered = row.arrangement == Arrangement::staggered;
  const double half = row.width_m / 2;
  std::vector<RoadLuminaire> lamps;
  const auto add = [&](double x, double side) {
    const bool central = row.arrangement == Arrangement::central;
    lamps.push_back({{x, central ? 0 : side * (half - row.overhang_m)},
                     row.height_m,
                     {0, -side},
                     0,
                     row.flux_lm,
                     row.profile});
  };
  const double period = row.spacing_m * (staggered ? 2 : 1);
  const int reach = 2 + static_cast<int>(std::ceil(reach_heights * row.height_m / row.spacing_m));
  for (int k = -reach; k <= reach; ++k) {
    const double x = k * row.spacing_m;
    add(x, staggered && k % 2 != 0 ? -1 : 1);
    if (row.arrangement == Arrangement::opposite) add(x, -1);
  }

  const int along = std::max(10, static_cast<int>(std::ceil(period / 3 - 1e-9)));
  const int across = points_across(row.width_m);
  FieldSummary result{0, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const glm::dvec2 point((i + 0.5) * period / along, ((j + 0.5) / across - 0.5) * row.width_m);
      double sum = 0;
      for (const RoadLuminaire& lamp : lamps) sum += illuminance(lamp, point);
      result.average_lx += sum / (along * across);
      result.min_lx = std::min(result.min_lx, sum);
    }
  return result;
}

}  // namespace nightcity::layout
