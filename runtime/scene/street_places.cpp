#include "runtime/scene/street_places.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <set>
#include <utility>

namespace nightcity::scene {
namespace {

constexpr double place_step_m = 5;
constexpr double half_lane_m = 1.75;  // of a lane of 3.5 m (RASt 06)
constexpr double min_speed_m_s = 1;   // slower vehicles stand at a stop line or turn

bool lies_within(const LitPart& part, const glm::dvec2& at) {
  const glm::dvec2 centre(double(part.centre.x), double(part.centre.z));
  return glm::distance(at, centre) < double(part.radius_m);
}

// Returns places on the centrelines of named streets. Squares are points, and no streets.
std::vector<StreetPlace> list_named_places(const RenderScene& scene, const LitPart& part) {
  std::vector<StreetPlace> places, within;
  for (const NamedStreet& street : scene.places.streets)
    for (const auto& line : street.lines) add_places(line, place_step_m, places);
  std::copy_if(places.begin(), places.end(), std::back_inserter(within),
               [&](const StreetPlace& place) { return lies_within(part, place.at); });
  return within;
}

// Returns places beside the ways of vehicles, one of each cell of `place_step_m`.
std::vector<StreetPlace> list_places_of_vehicles(const RenderScene& scene, const LitPart& part) {
  std::vector<StreetPlace> places;
  std::set<std::pair<long, long>> taken;
  for (const TripKnot& knot : scene.traffic.knots) {
    const glm::dvec2 at(double(knot.position.x), double(knot.position.z)),
        velocity(double(knot.velocity.x), double(knot.velocity.z));
    if (!lies_within(part, at) || !(glm::length(velocity) > min_speed_m_s)) continue;
    if (!taken.emplace(std::lround(at.x / place_step_m), std::lround(at.y / place_step_m)).second)
      continue;
    const glm::dvec2 along = glm::normalize(velocity), aside(-along.y, along.x);
    for (const double side : {-half_lane_m, half_lane_m})
      places.push_back({at + side * aside, along});
  }
  return places;
}

}  // namespace

double find_length_of(const std::vector<glm::dvec2>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += glm::distance(line[i - 1], line[i]);
  return length;
}

void add_places(const std::vector<glm::dvec2>& line, double step_m,
                std::vector<StreetPlace>& places) {
  double next_m = std::min(step_m, find_length_of(line)) / 2, done_m = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const glm::dvec2 &a = line[i - 1], &b = line[i];
    const double length_m = glm::distance(a, b);
    if (!(length_m > 0)) continue;
    for (; next_m <= done_m + length_m; next_m += step_m)
      places.push_back({glm::mix(a, b, (next_m - done_m) / length_m), (b - a) / length_m});
    done_m += length_m;
  }
}

std::vector<StreetPlace> list_street_places(const RenderScene& scene, const LitPart& part,
                                            std::size_t count) {
  std::vector<StreetPlace> places = list_named_places(scene, part);
  if (places.empty()) places = list_places_of_vehicles(scene, part);
  const std::size_t step =
      std::max<std::size_t>(1, places.size() / std::max<std::size_t>(1, count));
  std::vector<StreetPlace> some;
  for (std::size_t i = step / 2; i < places.size(); i += step) some.push_back(places[i]);
  return some;
}

}  // namespace nightcity::scene
