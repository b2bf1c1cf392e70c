#include "tools/town/street_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/random.h"

namespace nightcity::town {
namespace {

constexpr double bend_m = 15,
                 bend_wave_m = 520;  // the bends of streets: shear below 11 degrees
constexpr double jitter_m = 4;

std::vector<double> spaced(std::uint64_t seed, int purpose, int count, double low, double high) {
  // One line beyond the town on each side gives the outermost streets their outer kerb.
  std::vector<double> at(static_cast<std::size_t>(count) + 3, 0);
  for (std::size_t i = 1; i < at.size(); ++i)
    at[i] = at[i - 1] +
            Random{static_cast<std::int64_t>(seed), purpose, static_cast<std::int64_t>(i)}.range(
                low, high);
  const double middle = (at[1] + at[at.size() - 2]) / 2;
  for (double& value : at) value -= middle;
  return at;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

StreetSize size_of(StreetClass street) {
  switch (street) {
    case StreetClass::primary:
      return {11.0, 4.0, 26};
    case StreetClass::secondary:
      return {9.0, 3.5, 28};
    case StreetClass::tertiary:
      return {7.5, 3.0, 30};
    case StreetClass::residential:
      return {6.0, 2.4, 33};
    case StreetClass::living_street:
      return {5.5, 2.0, 28};
    case StreetClass::pedestrian:
      return {7.0, 1.8, 22};
    case StreetClass::footway:
      break;
  }
  return {2.5, 0.0, 24};
}

const char* osm_name(StreetClass street) {
  constexpr const char* names[] = {"primary",       "secondary",  "tertiary", "residential",
                                   "living_street", "pedestrian", "footway"};
  return names[static_cast<int>(street)];
}

glm::dvec2 meet(const glm::dvec2& a, const glm::dvec2& u, const glm::dvec2& b,
                const glm::dvec2& v) {
  return a + u * (cross(b - a, v) / cross(u, v));
}

Quad inset_quad(const Quad& quad, const std::array<double, 4>& distance) {
  Quad result;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t before = (k + 3) % 4;
    const glm::dvec2 u = glm::normalize(quad[k] - quad[before]),
                     v = glm::normalize(quad[(k + 1) % 4] - quad[k]);
    const glm::dvec2 left_u(-u.y, u.x), left_v(-v.y, v.x);
    result[k] = meet(quad[k] + left_u * distance[before], u, quad[k] + left_v * distance[k], v);
  }
  return result;
}

StreetPlan::StreetPlan(const TownOptions& options)
    : seed_(options.seed),
      columns_(options.columns),
      rows_(options.rows),
      column_x_(spaced(options.seed, 2, options.columns, 84, 118)),
      row_y_(spaced(options.seed, 3, options.rows, 68, 92)) {
  Random random{static_cast<std::int64_t>(seed_), 4};
  phase_.x = random.range(0, 2 * std::numbers::pi);
  phase_.y = random.range(0, 2 * std::numbers::pi);
  low_ = glm::dvec2(column_x_[1], row_y_[1]) - (bend_m + jitter_m + 20);
  high_ = glm::dvec2(column_x_[column_x_.size() - 2], row_y_[row_y_.size() - 2]) +
          (bend_m + jitter_m + 20);
}

glm::dvec2 StreetPlan::node(int i, int j) const {
  const glm::dvec2 p(column_x_[static_cast<std::size_t>(i + 1)],
                     row_y_[static_cast<std::size_t>(j + 1)]);
  Random random{static_cast<std::int64_t>(seed_), 5, i, j};
  const double dx = random.range(-jitter_m, jitter_m), dy = random.range(-jitter_m, jitter_m);
  const double k = 2 * std::numbers::pi / bend_wave_m;
  return {p.x + bend_m * std::sin(k * p.y + phase_.x) + dx,
          p.y + bend_m * std::sin(k * p.x + phase_.y) + dy};
}

StreetClass StreetPlan::row_street(int i, int j) const {
  if (j == rows_ / 2 && std::abs(i - columns_ / 2) > 1) return StreetClass::primary;
  if (j == rows_ / 2) return StreetClass::secondary;  // along the market
  if (j == rows_ / 2 + 1 && i == columns_ / 2) return StreetClass::pedestrian;
  if ((j - rows_ / 2) % 4 == 0) return StreetClass::secondary;
  const double pick = Random{static_cast<std::int64_t>(seed_), 6, j}.uniform();
  if (pick < 0.25) return StreetClass::tertiary;
  return pick < 0.4 ? StreetClass::living_street : StreetClass::residential;
}

StreetClass StreetPlan::column_street(int i, int j) const {
  if (j == rows_ / 2 && (i == columns_ / 2 || i == columns_ / 2 + 1))
    return StreetClass::pedestrian;
  if (std::abs(i - columns_ / 2) % 4 == 2) return StreetClass::secondary;
  Random random{static_cast<std::int64_t>(seed_), 7, i};
  return random.chance(0.25) ? StreetClass::tertiary : StreetClass::residential;
}

StreetClass StreetPlan::side_street(int i, int j, int side) const {
  switch (side) {
    case 0:
      return row_street(i, j);
    case 1:
      return column_street(i + 1, j);
    case 2:
      return row_street(i, j + 1);
    default:
      return column_street(i, j);
  }
}

Quad StreetPlan::inset(int i, int j, bool behind_pavement) const {
  std::array<double, 4> distance;
  for (int side = 0; side < 4; ++side) {
    const StreetSize size = size_of(side_street(i, j, side));
    distance[static_cast<std::size_t>(side)] =
        size.carriageway_m / 2 + (behind_pavement ? size.pavement_m : 0);
  }
  return inset_quad({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}, distance);
}

double StreetPlan::remoteness(int i, int j) const {
  const double x = (i - columns_ / 2) / std::max(1.0, columns_ / 2.0);
  const double y = (j - rows_ / 2) / std::max(1.0, rows_ / 2.0);
  return std::min(1.0, std::sqrt(x * x + y * y));
}

BlockUse StreetPlan::use(int i, int j) const {
  if (i == columns_ / 2 && j == rows_ / 2) return BlockUse::market;
  Random random{static_cast<std::int64_t>(seed_), 8, i, j};
  const double r = remoteness(i, j) + random.range(-0.08, 0.08);
  const double pick = random.uniform();
  if (pick < 0.06) return BlockUse::park;
  if (r < 0.7) return pick < 0.16 ? BlockUse::courtyard : BlockUse::perimeter;
  if (r < 0.9)
    return pick < 0.5 ? BlockUse::perimeter : pick < 0.68 ? BlockUse::slabs : BlockUse::houses;
  return pick < 0.16 ? BlockUse::hall : pick < 0.24 ? BlockUse::slabs : BlockUse::houses;
}

}  // namespace nightcity::town
