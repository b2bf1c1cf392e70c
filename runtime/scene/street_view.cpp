#include "runtime/scene/street_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "runtime/scene/lit_part.h"
#include "runtime/scene/standpoint.h"

namespace nightcity::scene {
namespace {

constexpr std::size_t max_lamps = 60, max_places = 600, looked_at = 24;

// A standpoint with its best view.
struct Place {
  Standpoint from;
  int ahead = 0;
  double score = 0;
};

std::optional<Place> rate_place(const RenderScene& scene, double x, double z) {
  const std::optional<Standpoint> from = find_standpoint(scene, x, z);
  if (!from) return std::nullopt;
  Place place{*from};
  for (int i = 0; i < sight_count; ++i)
    if (const double score = rate_view(place.from, i); score > place.score) {
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
  for (Place& place : places)
    place.score *= 1 + std::log1p(rate_lights(scene, place.from, place.ahead));
  const Place& best = *std::min_element(places.begin(), places.end(), better);
  return look_from(best.from, direction_of(best.ahead));
}

}  // namespace nightcity::scene
