#include "tools/lights/lamp_hours.h"

#include <algorithm>
#include <tuple>

namespace nightcity::lights {
namespace {

const NightSpan* span_of(const std::map<std::string, NightSpan>& spans, std::string_view highway) {
  const auto found = spans.find(std::string(highway));
  return found == spans.end() ? nullptr : &found->second;
}

}  // namespace

void switch_lamps(const LampHours& hours, LampSet& set) {
  std::vector<PlacedLamp*> halves;  // in the half-night roads
  auto& counts = set.sources["hours"];
  for (PlacedLamp& lamp : set.lamps) {
    if (lamp.provenance.schedule == ValueSource::tag) {
      ++counts["tag"];
    } else if (const NightSpan* dark = span_of(hours.off, lamp.highway)) {
      lamp.hours = dark_between(dark->from, dark->to);
      ++counts["rule"];
    } else if (span_of(hours.half_night, lamp.highway)) {
      halves.push_back(&lamp);
      ++counts["rule"];
    } else {
      ++counts["always on"];
    }
  }
  std::stable_sort(halves.begin(), halves.end(), [](const PlacedLamp* a, const PlacedLamp* b) {
    return std::tie(a->way_id, a->along_m) < std::tie(b->way_id, b->along_m);
  });
  std::size_t rank = 0;  // of the post along its way; the luminaires of a post switch together
  for (std::size_t n = 0; n < halves.size(); ++n) {
    if (n > 0 && halves[n]->way_id != halves[n - 1]->way_id)
      rank = 0;
    else if (n > 0 && halves[n]->foot != halves[n - 1]->foot)
      ++rank;
    if (rank % 2 == 0) continue;
    const NightSpan* dark = span_of(hours.half_night, halves[n]->highway);
    halves[n]->hours = dark_between(dark->from, dark->to);
  }
}

}  // namespace nightcity::lights
