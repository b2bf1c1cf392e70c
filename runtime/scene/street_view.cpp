#include "runtime/scene/street_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "runtime/scene/carriageway.h"
#include "runtime/scene/lit_part.h"
#include "runtime/scene/standpoint.h"
#include "runtime/scene/street_places.h"

namespace nightcity::scene {
namespace {

constexpr std::size_t max_lamps = 60, max_places = 600, looked_at = 24, max_on_streets = 400;
// A carriageway goes on so far where one looks along it; farther ahead makes a view no better.
constexpr double runs_on_m = 25, runs_far_m = 50;

// A standpoint with a view from there.
struct Place {
  Standpoint from;
  glm::dvec3 ahead{0};
  double score = 0;
};

// Returns the best view of a standpoint.
Place rate_place(const Standpoint& from) {
  Place place{from};
  for (int i = 0; i < sight_count; ++i)
    if (const double score = rate_view(from, i); score > place.score) {
      place.score = score;
      place.ahead = direction_of(i);
    }
  return place;
}

// Returns the best view of a standpoint along the carriageway below it, of score 0 where there is
// none.
Place rate_along_carriageway(const RenderScene& scene, const Standpoint& from) {
  Place place{from};
  if (!stands_on_carriageway(scene, from.eye)) return place;
  for (int i = 0; i < sight_count; ++i)
    if (const double score = rate_view(from, i);
        score > place.score &&
        find_carriageway_ahead(scene, from.eye, direction_of(i), runs_on_m) >= runs_on_m) {
      place.score = score;
      place.ahead = direction_of(i);
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

std::vector<Standpoint> find_standpoints(const RenderScene& scene,
                                         const std::vector<glm::dvec2>& places) {
  std::vector<Standpoint> found;
  for (const glm::dvec2& at : places)
    if (const auto from = find_standpoint(scene, at.x, at.y)) found.push_back(*from);
  return found;
}

// Returns the best of the places by their views and then by the light along these.
std::optional<Place> choose(const RenderScene& scene, std::vector<Place> places) {
  std::erase_if(places, [](const Place& place) { return !(place.score > 0); });
  if (places.empty()) return std::nullopt;
  const auto better = [](const Place& a, const Place& b) { return a.score > b.score; };
  std::stable_sort(places.begin(), places.end(), better);
  if (places.size() > looked_at) places.resize(looked_at);
  for (Place& place : places)
    place.score *= 1 + std::log1p(rate_lights(scene, place.from, find_sight(place.ahead)));
  return *std::min_element(places.begin(), places.end(), better);
}

// Returns the best view along the streets that the scene knows, from their carriageways where it
// shows any.
std::optional<Place> choose_on_streets(const RenderScene& scene, const LitPart& part,
                                       bool shows_carriageways) {
  std::vector<Place> places;
  for (const StreetPlace& street : list_street_places(scene, part, max_on_streets)) {
    const auto from = find_standpoint(scene, street.at.x, street.at.y);
    if (!from || (shows_carriageways && !stands_on_carriageway(scene, from->eye))) continue;
    for (const double way : {1.0, -1.0}) {
      const glm::dvec3 ahead(way * street.along.x, 0, way * street.along.y);
      // Streets curve: a short carriageway ahead makes a view worse, and not impossible.
      const double runs_m = find_carriageway_ahead(scene, from->eye, ahead, runs_far_m);
      const double share = shows_carriageways ? 0.25 + 0.75 * runs_m / runs_far_m : 1;
      places.push_back({*from, ahead, share * rate_view(*from, find_sight(ahead))});
    }
  }
  return choose(scene, std::move(places));
}

std::optional<Place> choose_place(const RenderScene& scene) {
  const LitPart part = find_lit_part(scene);
  std::vector<Standpoint> standpoints = find_standpoints(scene, places_at_lamps(scene, part));
  for (const Standpoint& from : find_standpoints(scene, places_all_over(part)))
    standpoints.push_back(from);
  std::vector<Place> places;
  for (const Standpoint& from : standpoints) places.push_back(rate_place(from));
  const std::optional<Place> anywhere = choose(scene, places);
  const bool shows_carriageways = has_carriageways(scene);
  if (anywhere && shows_carriageways &&
      find_carriageway_ahead(scene, anywhere->from.eye, anywhere->ahead, runs_on_m) >= runs_on_m)
    return anywhere;
  if (const auto place = choose_on_streets(scene, part, shows_carriageways)) return place;
  if (!shows_carriageways) return anywhere;
  places.clear();
  for (const Standpoint& from : standpoints) places.push_back(rate_along_carriageway(scene, from));
  if (const auto place = choose(scene, std::move(places))) return place;
  return anywhere;
}

}  // namespace

std::optional<CameraPose> find_street_view(const RenderScene& scene) {
  if (scene.bounds.empty()) return std::nullopt;
  const std::optional<Place> best = choose_place(scene);
  if (!best) return std::nullopt;
  return look_from(best->from, best->ahead);
}

}  // namespace nightcity::scene
