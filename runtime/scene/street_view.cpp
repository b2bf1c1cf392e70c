#include "runtime/scene/street_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "runtime/scene/lit_part.h"
#include "runtime/scene/trace_ray.h"

namespace nightcity::scene {
namespace {

constexpr float eye_height_m = 1.7f;
constexpr double clear_m = 1.5;       // nearest wall around a place to stand
constexpr double sight_m = 250;       // farther ahead makes a view no better
constexpr double street_half_m = 20;  // walls within this distance to the side make a street
constexpr float roof_m = 2.5f;        // higher than the lowest ground around: a roof, not a street
constexpr double around_m = 30;       // where that ground is looked for
constexpr int directions = 32;
constexpr std::size_t max_lamps = 60, max_places = 600, looked_at = 24;

using Distances = std::array<double, directions>;

glm::dvec3 direction_of(int i) {
  const double angle = 2 * 3.14159265358979 * i / directions;
  return {std::cos(angle), 0, std::sin(angle)};
}

// Returns the height of the topmost surface at a place, nothing beside the model.
std::optional<double> find_top(const RenderScene& scene, double x, double z) {
  const double above = double(scene.bounds.upper.y) + 1;
  const auto hit = trace_ray(scene, {x, above, z}, {0, -1, 0}, 1e6, MASK_SHADOW);
  if (!hit) return std::nullopt;
  return above - hit->distance;
}

// Returns where a pedestrian's eye would be at a place, unless that is a roof: the topmost surface
// there is much higher than the lowest around it.
std::optional<glm::dvec3> find_eye(const RenderScene& scene, double x, double z) {
  const std::optional<double> here = find_top(scene, x, z);
  if (!here) return std::nullopt;
  double lowest = *here;
  for (int i = 0; i < directions; i += 4)
    for (const double share : {0.3, 1.0}) {
      const glm::dvec3 at = glm::dvec3(x, 0, z) + share * around_m * direction_of(i);
      lowest = std::min(lowest, find_top(scene, at.x, at.z).value_or(lowest));
    }
  if (*here > lowest + double(roof_m)) return std::nullopt;
  return glm::dvec3(x, *here + double(eye_height_m), z);
}

struct Place {
  glm::dvec3 eye;
  Distances open;  // free way in each direction, m
  int ahead = 0;   // the direction of the best view
  double score = 0;
};

double open_at(const Distances& open, int i) {
  return open[static_cast<std::size_t>((i + directions) % directions)];
}

// Rates a view by what makes a street: a long way ahead and some behind, walls to both sides.
double rate_view(const Distances& open, int i) {
  const double ahead = std::min(open_at(open, i), 150.0),
               behind = std::min(open_at(open, i + 16), 60.0);
  const double left = open_at(open, i - 8), right = open_at(open, i + 8);
  const int walls = (left < street_half_m) + (right < street_half_m);
  const double middle = std::min(left, right) / std::max(1.0, std::max(left, right));
  return std::sqrt(ahead) * (1 + walls) * (0.5 + std::min(middle, 1.0)) * (1 + behind / 60);
}

std::optional<Place> rate_place(const RenderScene& scene, double x, double z) {
  const std::optional<glm::dvec3> eye = find_eye(scene, x, z);
  if (!eye) return std::nullopt;
  Place place{*eye, {}};
  for (int i = 0; i < directions; ++i) {
    const auto hit = trace_ray(scene, *eye, direction_of(i), sight_m, MASK_VISIBLE);
    const double open = hit ? hit->distance : sight_m;
    if (open < clear_m) return std::nullopt;
    place.open[static_cast<std::size_t>(i)] = open;
  }
  for (int i = 0; i < directions; ++i)
    if (const double score = rate_view(place.open, i); score > place.score) {
      place.score = score;
      place.ahead = i;
    }
  return place;
}

// Beside a lamp one stands in the street; below a window one would stand in the house.
bool stands_in_the_street(const Light& light) {
  switch (light_kind(light)) {
    case LightKind::sphere:
      return light.flux_lm > 0;
    case LightKind::rectangle:
      return false;
  }
  return false;
}

// Returns places in front of the lamps nearest to the centre, out from the post towards the road.
std::vector<glm::dvec2> places_at_lamps(const RenderScene& scene, const LitPart& part) {
  std::vector<const Light*> lamps;
  for (const Light& light : scene.lights)
    if (stands_in_the_street(light)) lamps.push_back(&light);
  const auto distance = [&](const Light* lamp) {
    return std::hypot(lamp->position.x - part.centre.x, lamp->position.z - part.centre.z);
  };
  std::sort(lamps.begin(), lamps.end(),
            [&](const Light* a, const Light* b) { return distance(a) < distance(b); });
  if (lamps.size() > max_lamps) lamps.resize(max_lamps);
  std::vector<glm::dvec2> places;
  for (const Light* lamp : lamps) {
    glm::dvec2 out(double(lamp->tangent.x), double(lamp->tangent.z));
    out = glm::length(out) > 0.5 ? glm::normalize(out) : glm::dvec2(1, 0);
    places.push_back(glm::dvec2(double(lamp->position.x), double(lamp->position.z)) + 3.0 * out);
  }
  return places;
}

// Returns places all over the lit part, from its centre outwards: a sunflower's (Vogel 1979).
std::vector<glm::dvec2> places_all_over(const LitPart& part) {
  std::vector<glm::dvec2> places;
  for (std::size_t i = 0; i < max_places; ++i) {
    const double r = double(part.radius_m) * std::sqrt((double(i) + 0.5) / double(max_places));
    const double angle = 2.399963229728653 * double(i);
    places.push_back(glm::dvec2(double(part.centre.x), double(part.centre.z)) +
                     r * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return places;
}

// Returns how much light lies along the view: lights within a cone ahead, near ones more.
double rate_lights(const RenderScene& scene, const Place& place) {
  const glm::dvec3 ahead = direction_of(place.ahead);
  const double open = open_at(place.open, place.ahead);
  double sum = 0;
  for (const Light& light : scene.lights) {
    if (!(light.flux_lm > 0)) continue;
    const glm::dvec3 to = glm::dvec3(light.position) - place.eye;
    const double along = glm::dot(to, ahead);
    if (along > 5 && along < open && glm::length(to - along * ahead) < 0.4 * along)
      sum += 1 / (1 + along / 60);
  }
  return sum;
}

}  // namespace

std::optional<CameraPose> find_street_view(const RenderScene& scene) {
  if (scene.bounds.empty()) return std::nullopt;
  const LitPart part = find_lit_part(scene);
  std::vector<Place> places;
  const auto rate_all = [&](const std::vector<glm::dvec2>& tried) {
    for (const glm::dvec2& at : tried)
      if (const auto place = rate_place(scene, at.x, at.y)) places.push_back(*place);
  };
  rate_all(places_at_lamps(scene, part));
  rate_all(places_all_over(part));
  if (places.empty()) return std::nullopt;
  const auto better = [](const Place& a, const Place& b) { return a.score > b.score; };
  std::stable_sort(places.begin(), places.end(), better);
  if (places.size() > looked_at) places.resize(looked_at);
  for (Place& place : places) place.score *= 1 + std::log1p(rate_lights(scene, place));
  const Place& best = *std::min_element(places.begin(), places.end(), better);

  CameraPose pose;
  pose.position = glm::vec3(best.eye);
  pose.target = glm::vec3(best.eye + 30.0 * direction_of(best.ahead) + glm::dvec3(0, 1.5, 0));
  pose.fov_deg = 65;
  return pose;
}

}  // namespace nightcity::scene
