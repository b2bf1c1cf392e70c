// Decides which of several places is the city's.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/survey/survey.h"

namespace nightcity::survey {

/// Files that lie near each other.
struct Place {
  std::vector<const SurveyedFile*> files;
  Box box;
  std::size_t companions = 0;  // other files that lie here
};

struct PlaceChoice {
  std::vector<Place> places;  // by their first file
  std::size_t chosen = 0;
  std::string reason;  // why the others were not taken: "lies elsewhere than most of its kind"
};

/// Sorts files into places, where each lies within `near_degrees` of the others of its own, and
/// chooses the one with the most companions, of alike ones that with the most files, of alike ones
/// the first. `lies_at` says whether one of `others` lies in a box.
PlaceChoice choose_place(const std::vector<const SurveyedFile*>& files, double near_degrees,
                         const std::vector<const SurveyedFile*>& others,
                         const std::function<bool(const SurveyedFile&, const Box&)>& lies_at);

}  // namespace nightcity::survey
