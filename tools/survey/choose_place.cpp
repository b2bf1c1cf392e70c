#include "tools/survey/choose_place.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace nightcity::survey {
namespace {

void add(Place& place, const Place& more) {
  place.files.insert(place.files.end(), more.files.begin(), more.files.end());
  if (more.box.empty()) return;
  place.box.add(more.box.least);
  place.box.add(more.box.greatest);
}

// A file joins all places that it is near to. A box that grows may come near to another, so places
// are joined until none is near to any other.
std::vector<Place> find_places(const std::vector<const SurveyedFile*>& files, double near_degrees) {
  std::vector<Place> places;
  for (const SurveyedFile* file : files) {
    Place place{{file}, file->box};
    while (true) {
      const auto near = std::find_if(places.begin(), places.end(), [&](const Place& other) {
        return other.box.is_near(place.box, near_degrees);
      });
      if (near == places.end()) break;
      Place joined = std::move(*near);
      places.erase(near);
      add(joined, place);
      place = std::move(joined);
    }
    places.push_back(std::move(place));
  }
  const auto is_before = [](const SurveyedFile* a, const SurveyedFile* b) {
    return a->path < b->path;
  };
  for (Place& place : places) std::sort(place.files.begin(), place.files.end(), is_before);
  std::sort(places.begin(), places.end(), [&](const Place& a, const Place& b) {
    return is_before(a.files.front(), b.files.front());
  });
  return places;
}

}  // namespace

PlaceChoice choose_place(const std::vector<const SurveyedFile*>& files, double near_degrees,
                         const std::vector<const SurveyedFile*>& others,
                         const std::function<bool(const SurveyedFile&, const Box&)>& lies_at) {
  PlaceChoice choice;
  choice.places = find_places(files, near_degrees);
  if (choice.places.size() < 2) return choice;
  for (Place& place : choice.places)
    place.companions = static_cast<std::size_t>(
        std::count_if(others.begin(), others.end(), [&](const SurveyedFile* other) {
          return !place.box.empty() && lies_at(*other, place.box);
        }));
  const auto best = std::max_element(
      choice.places.begin(), choice.places.end(), [](const auto& a, const auto& b) {
        return std::tuple(a.companions, a.files.size()) < std::tuple(b.companions, b.files.size());
      });
  choice.chosen = static_cast<std::size_t>(best - choice.places.begin());
  const auto all_have = [&](auto value) {
    return std::all_of(choice.places.begin(), choice.places.end(),
                       [&](const Place& place) { return value(place) == value(*best); });
  };
  if (!all_have([](const Place& place) { return place.companions; }))
    choice.reason = "lies elsewhere than what goes with the others";
  else if (!all_have([](const Place& place) { return place.files.size(); }))
    choice.reason = "lies elsewhere than most of its kind";
  else
    choice.reason = "lies elsewhere than the first of its kind";
  return choice;
}

}  // namespace nightcity::survey
