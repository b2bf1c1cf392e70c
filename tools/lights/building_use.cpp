#include "tools/lights/building_use.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/in_ring.h"
#include "tools/osm/tag_values.h"
#include "tools/ring_area.h"

namespace nightcity::lights {
namespace {

struct Range {
  int first, last;
  BuildingUse use;
};

template <std::size_t N>
KnownUse look_up(const std::array<Range, N>& table, int code) {
  for (const Range& range : table)
    if (code >= range.first && code <= range.last) return {range.use, true, false};
  return {};
}

using enum BuildingUse;

// ALKIS object type 31001, attribute GFK (AdV, GeoInfoDok 6 and 7). First match wins.
constexpr std::array<Range, 40> alkis = {{
    {1000, 1099, residential}, {1110, 1131, mixed},      {1220, 1223, residential},
    {1310, 1312, residential}, {1313, 1313, dark},       {2010, 2010, retail},
    {2020, 2040, office},      {2050, 2056, retail},     {2060, 2060, civic},
    {2070, 2075, hotel},       {2080, 2083, retail},     {2090, 2094, civic},
    {2100, 2129, industrial},  {2130, 2131, retail},     {2140, 2143, industrial},
    {2150, 2180, industrial},  {2200, 2213, industrial}, {2220, 2220, dark},
    {2310, 2310, mixed},       {2320, 2320, mixed},      {2400, 2431, civic},
    {2440, 2459, dark},        {2460, 2465, dark},       {2500, 2523, dark},
    {2540, 2623, dark},        {2700, 2729, dark},       {2740, 2742, dark},
    {3010, 3019, civic},       {3020, 3024, education},  {3030, 3038, civic},
    {3040, 3048, dark},        {3050, 3052, civic},      {3060, 3062, civic},
    {3065, 3065, education},   {3070, 3075, civic},      {3080, 3082, dark},
    {3090, 3098, civic},       {3100, 3100, mixed},      {3200, 3290, civic},
    {9998, 9998, residential},
}};

// PLATEAU Building_usage.
constexpr std::array<Range, 16> plateau = {{
    {401, 401, office},
    {402, 402, retail},
    {403, 403, hotel},
    {404, 404, retail},
    {411, 412, residential},
    {413, 414, mixed},
    {415, 415, mixed},
    {421, 421, civic},
    {422, 422, education},
    {431, 431, industrial},
    {441, 441, industrial},
    {451, 452, dark},
    {453, 453, civic},
    {454, 454, civic},
    {461, 461, residential},
    {400, 400, office},
}};

// CityGML 2.0, annex C: _AbstractBuilding_function.
constexpr std::array<Range, 12> citygml = {{
    {1000, 1020, residential},
    {1030, 1090, mixed},
    {1100, 1110, residential},
    {1120, 1140, office},
    {1150, 1200, retail},
    {1210, 1230, hotel},
    {1240, 1300, retail},
    {1310, 1400, industrial},
    {1410, 1460, dark},
    {1470, 1640, dark},
    {1810, 1900, civic},
    {1950, 2090, civic},
}};

struct Word {
  std::string_view part;
  BuildingUse use;
};
constexpr std::array<Word, 35> words = {{
    {"man_made", dark},  // chimneys and tanks of the map (map_buildings::name_tall_function)
    {"wohn_und_gesch", mixed},
    {"mixed", mixed},
    {"garage", dark},
    {"carport", dark},
    {"shed", dark},
    {"schuppen", dark},
    {"church", dark},
    {"kirche", dark},
    {"greenhouse", dark},
    {"barn", dark},
    {"parking", dark},
    {"hotel", hotel},
    {"wohn", residential},
    {"residential", residential},
    {"dwelling", residential},
    {"house", residential},
    {"apartment", residential},
    {"habitation", residential},
    {"asuin", residential},
    {"office", office},
    {"buero", office},
    {"toimisto", office},
    {"shop", retail},
    {"retail", retail},
    {"commerc", retail},
    {"geschaeft", retail},
    {"restaurant", retail},
    {"school", education},
    {"schule", education},
    {"universit", education},
    {"hospital", civic},
    {"public", civic},
    {"industr", industrial},
    {"factory", industrial},
}};

// The outlines of a roof in plan, the exterior first.
using PlanRings = std::vector<std::vector<glm::dvec2>>;

PlanRings to_plan(const city::Polygon& polygon) {
  PlanRings rings;
  const auto add = [&](const city::Ring& ring) {
    rings.emplace_back();
    for (const glm::dvec3& p : ring) rings.back().emplace_back(p);
  };
  add(polygon.exterior);
  for (const city::Ring& hole : polygon.interiors) add(hole);
  return rings;
}

bool is_within(const PlanRings& rings, const glm::dvec2& place) {
  return std::count_if(rings.begin(), rings.end(),
                       [&](const std::vector<glm::dvec2>& ring) { return in_ring(ring, place); }) %
             2 ==
         1;
}

// Returns the middle of the longest stretch within the rings of the line through them from west to
// east at half of their height; none where they enclose nothing there.
std::optional<glm::dvec2> find_place_within(const PlanRings& rings) {
  const auto [south, north] =
      std::minmax_element(rings.front().begin(), rings.front().end(),
                          [](const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y; });
  const double y = (south->y + north->y) / 2;
  std::vector<double> crossings;
  for (const std::vector<glm::dvec2>& ring : rings)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const glm::dvec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
      if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  std::sort(crossings.begin(), crossings.end());
  std::optional<glm::dvec2> place;
  double longest = 0;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
    if (const double length = crossings[k + 1] - crossings[k]; length > longest) {
      longest = length;
      place = {(crossings[k] + crossings[k + 1]) / 2, y};
    }
  return place;
}

// Returns `middle`, that of the building's box, where it lies below a roof of the building, else a
// place below the largest roof: the middle of a house round a courtyard may be another's.
glm::dvec2 find_place_of(const city::CityObject& building, const glm::dvec2& middle) {
  const city::Polygon* largest = nullptr;
  double greatest_m2 = 0;
  for (const city::Polygon& polygon : building.polygons) {
    if (polygon.surface != city::SurfaceType::roof || polygon.exterior.empty()) continue;
    const PlanRings rings = to_plan(polygon);
    if (is_within(rings, middle)) return middle;
    const double area_m2 = std::abs(signed_area(rings.front()));
    if (area_m2 > greatest_m2) greatest_m2 = area_m2, largest = &polygon;
  }
  return largest ? find_place_within(to_plan(*largest)).value_or(middle) : middle;
}

}  // namespace

const char* name_of(BuildingUse use) {
  constexpr const char* names[] = {"residential", "mixed", "office",     "retail", "hotel",
                                   "education",   "civic", "industrial", "dark"};
  return names[static_cast<int>(use)];
}

KnownUse use_from_code(std::string_view code) {
  // "31001_1010" is the object type and the value.
  const std::size_t underscore = code.rfind('_');
  std::string_view digits = code;
  const bool adv = underscore != std::string_view::npos &&
                   (code.starts_with("31001") || code.starts_with("99999"));
  if (adv) digits = code.substr(underscore + 1);
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc() && end == digits.data() + digits.size()) {
    if (adv) return look_up(alkis, number);
    return digits.size() == 3 ? look_up(plateau, number) : look_up(citygml, number);
  }
  const std::string text = osm::normalise_tag(code);
  for (const Word& word : words)
    if (text.find(word.part) != std::string::npos) return {word.use, true, false};
  return {};
}

KnownUse use_of(const city::CityObject& building, const UseAt& map) {
  for (const std::string* code : {&building.function, &building.usage, &building.building_class})
    if (const KnownUse use = use_from_code(*code); use.stated)
      return {use.use, !building.of_map, building.of_map};
  glm::dvec2 west_south(std::numeric_limits<double>::infinity()), east_north(-west_south);
  double area = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (const city::Polygon& polygon : building.polygons) {
    double twice = 0;
    for (std::size_t k = 0; k < polygon.exterior.size(); ++k) {
      const glm::dvec3 &a = polygon.exterior[k],
                       &b = polygon.exterior[(k + 1) % polygon.exterior.size()];
      const glm::dvec3& o = polygon.exterior.front();
      twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
      west_south = glm::min(west_south, glm::dvec2(a));
      east_north = glm::max(east_north, glm::dvec2(a));
      low = std::min(low, a.z);
      high = std::max(high, a.z);
    }
    if (polygon.surface == city::SurfaceType::roof) area += std::abs(twice) / 2;
  }
  if (map && west_south.x <= east_north.x)
    if (const auto use = map(find_place_of(building, (west_south + east_north) * 0.5)))
      return {*use, false, true};
  const bool hut = high - low < 3 || (area > 0 && area < 25);
  return {hut ? dark : residential, false, false};
}

}  // namespace nightcity::lights
