#include "runtime/scene/named_street_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "formats/error.h"
#include "runtime/scene/standpoint.h"
#include "runtime/scene/street_names.h"
#include "runtime/scene/street_places.h"

namespace nightcity::scene {
namespace {

struct StreetSight {
  Standpoint from;
  glm::dvec3 ahead;
  double score;
};

constexpr std::size_t max_street_places = 120, max_compared = 12;
constexpr double named_step_m = 5, square_m = 30;

// Adds places around the middle of a square, from there outwards: a sunflower's (Vogel 1979).
void add_places_around(const glm::dvec2& middle, std::vector<StreetPlace>& places) {
  constexpr int count = 24;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.399963229728653 * i, r = square_m * std::sqrt(double(i) / count);
    places.push_back({middle + r * glm::dvec2(std::cos(angle), std::sin(angle)), {0, 0}});
  }
}

// Returns places on the squares of that name, else along its lines.
std::vector<StreetPlace> list_places(const NamedStreet& street) {
  std::vector<StreetPlace> places;
  double length_m = 0;
  for (const auto& line : street.lines) {
    if (line.size() == 1 && places.size() < max_street_places)
      add_places_around(line.front(), places);
    length_m += find_length_of(line);
  }
  if (!places.empty()) return places;
  const double step_m = std::max(named_step_m, length_m / double(max_street_places));
  for (const auto& line : street.lines)
    if (places.size() < 2 * max_street_places) add_places(line, step_m, places);
  return places;
}

// Adds the views from a place along the street, both ways, or all round on a square.
void add_sights(const Standpoint& from, const glm::dvec2& along, std::vector<StreetSight>& sights) {
  if (along == glm::dvec2(0)) {
    for (int i = 0; i < sight_count; ++i)
      sights.push_back({from, direction_of(i), rate_view(from, i)});
    return;
  }
  for (const double way : {1.0, -1.0}) {
    const glm::dvec3 ahead(way * along.x, 0, way * along.y);
    sights.push_back({from, ahead, rate_view(from, find_sight(ahead))});
  }
}

CameraPose look_from_above(const RenderScene& scene, const std::vector<StreetPlace>& places) {
  const glm::dvec2 middle = places.empty() ? glm::dvec2(0) : places[places.size() / 2].at;
  const double ground = scene.bounds.empty() ? 0 : double(scene.bounds.lower.y);
  const double height_m = scene.bounds.empty() ? 100 : double(scene.bounds.upper.y) - ground + 100;
  CameraPose pose;
  pose.target = glm::vec3(middle.x, ground, middle.y);
  pose.position = pose.target + glm::vec3(0, height_m, 0.7 * height_m);
  return pose;
}

}  // namespace

NamedStreetView find_view_of(const RenderScene& scene, const NamedStreet& street) {
  const std::vector<StreetPlace> places = list_places(street);
  std::vector<StreetSight> sights;
  if (!scene.bounds.empty())
    for (const StreetPlace& place : places)
      if (const auto from = find_standpoint(scene, place.at.x, place.at.y))
        add_sights(*from, place.along, sights);
  NamedStreetView view;
  if (sights.empty()) {
    view = {look_from_above(scene, places), true};
  } else {
    const auto better = [](const StreetSight& a, const StreetSight& b) {
      return a.score > b.score;
    };
    std::stable_sort(sights.begin(), sights.end(), better);
    sights.resize(std::min(sights.size(), max_compared));
    for (StreetSight& sight : sights)
      sight.score *= 1 + std::log1p(rate_lights(scene, sight.from, find_sight(sight.ahead)));
    const StreetSight& best = *std::min_element(sights.begin(), sights.end(), better);
    view.pose = look_from(best.from, best.ahead);
  }
  view.pose.origin = scene.origin;
  return view;
}

CameraPose find_view_of(const RenderScene& scene, const std::string& text) {
  const std::vector<std::size_t> found = find_streets(scene.places.streets, text);
  if (!found.empty()) return find_view_of(scene, scene.places.streets[found.front()]).pose;
  throw Error("camera", "street:" + text,
              scene.places.streets.empty()
                  ? "this scene has no names of streets: its map had none, or an older nightbake "
                    "made it"
                  : "none of " + std::to_string(scene.places.streets.size()) +
                        " streets and squares has this in its name");
}

}  // namespace nightcity::scene
