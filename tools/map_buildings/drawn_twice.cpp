#include "tools/map_buildings/drawn_twice.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "tools/map_buildings/building_tags.h"
#include "tools/osm/place_steps.h"
#include "tools/osm/tag_values.h"

namespace nightcity::map_buildings {
namespace {

using osm::MapArea, osm::PlaceSteps;

template <class Take>
void visit_corners(const MapArea& area, Take take) {
  for (const osm::MapRings& rings : area.rings) {
    for (const glm::dvec2& p : rings.outer) take(osm::round_to_steps(p));
    for (const auto& hole : rings.holes)
      for (const glm::dvec2& p : hole) take(osm::round_to_steps(p));
  }
}

// Rings may begin anywhere and run either way: the sum does not depend on it.
std::uint64_t hash_corners(const MapArea& area) {
  std::uint64_t sum = 0;
  visit_corners(area, [&](const PlaceSteps& corner) { sum += osm::hash_place(corner); });
  return sum;
}

// Buildings of one outline may stand on each other: those of one place have all of this in common.
using Signature = std::pair<std::vector<PlaceSteps>, std::string>;

Signature describe(const MapArea& area) {
  Signature signature;
  visit_corners(area, [&](const PlaceSteps& corner) { signature.first.push_back(corner); });
  std::sort(signature.first.begin(), signature.first.end());
  for (const char* key :
       {"min_height", "building:min_height", "building:min_level", "layer", "level", "location"})
    signature.second += osm::find_raw_tag(area.tags, key) + '\n';
  return signature;
}

bool says_more(const MapArea& a, const MapArea& b) {
  return std::tuple(b.tags.size(), a.id) < std::tuple(a.tags.size(), b.id);
}

}  // namespace

std::vector<std::size_t> find_standing(const std::vector<MapArea>& buildings, osm::Day day) {
  std::vector<std::size_t> standing(buildings.size());
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> by_corners;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    standing[i] = i;
    by_corners[hash_corners(buildings[i])].push_back(i);
  }
  for (auto& [hash, alike] : by_corners) {
    if (alike.size() < 2) continue;
    std::erase_if(alike, [&](std::size_t i) { return is_absent(buildings[i].tags, day); });
    std::map<Signature, std::vector<std::size_t>> places;
    for (const std::size_t i : alike) places[describe(buildings[i])].push_back(i);
    for (const auto& [signature, same] : places) {
      const std::size_t best = *std::min_element(
          same.begin(), same.end(),
          [&](std::size_t a, std::size_t b) { return says_more(buildings[a], buildings[b]); });
      for (const std::size_t i : same) standing[i] = best;
    }
  }
  return standing;
}

}  // namespace nightcity::map_buildings
