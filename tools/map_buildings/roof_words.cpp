#include "tools/map_buildings/roof_words.h"

#include <string>
#include <string_view>
#include <unordered_map>

#include "tools/osm/tag_values.h"

namespace nightcity::map_buildings {
namespace {

using S = RoofShape;

const std::unordered_map<std::string_view, RoofShape>& shapes() {
  static const std::unordered_map<std::string_view, RoofShape> table{
      {"", S::flat},
      {"flat", S::flat},
      {"gabled", S::gabled},
      {"gable", S::gabled},
      {"pitched", S::gabled},
      {"double_pitched", S::gabled},
      {"gambrel", S::gambrel},
      {"round", S::round},
      {"barrel", S::round},
      {"vault", S::round},
      {"arched", S::round},
      {"saltbox", S::saltbox},
      {"hipped", S::hipped},
      {"hip", S::hipped},
      {"equal_hipped", S::hipped},
      {"half_hipped", S::half_hipped},
      {"half_hip", S::half_hipped},
      {"jerkinhead", S::half_hipped},
      {"mansard", S::mansard},
      {"pyramidal", S::pyramidal},
      {"pyramid", S::pyramidal},
      {"tented", S::pyramidal},
      {"cone", S::pyramidal},
      {"conical", S::pyramidal},
      {"dome", S::dome},
      {"onion", S::onion},
      {"skillion", S::skillion},
      {"lean_to", S::skillion},
      {"shed", S::skillion},
      {"monopitch", S::skillion},
      {"mono_pitched", S::skillion},
      {"butterfly", S::butterfly},
      {"sawtooth", S::sawtooth},
      {"saw_tooth", S::sawtooth},
      {"gabled_row", S::gabled_row},
      {"m_shaped", S::gabled_row},
      {"double_saltbox", S::double_saltbox},
      {"quadruple_saltbox", S::quadruple_saltbox},
      {"side_hipped", S::side_hipped},
      {"side_half_hipped", S::side_half_hipped},
      {"hipped_and_gabled", S::gablet},
      {"gablet", S::gablet},
      {"dutch_gable", S::gablet},
      {"crosspitched", S::crosspitched},
      {"cross_pitched", S::crosspitched},
      {"cross_gabled", S::crosspitched},
      {"cross_gable", S::crosspitched}};
  return table;
}

struct Nearest {
  RoofShape shape;
  const char* name;
};

// Shapes that are shown as another one, which has the same outline from afar.
const std::unordered_map<std::string_view, Nearest>& nearest_shapes() {
  static const std::unordered_map<std::string_view, Nearest> table{
      {"gabled_height_moved", {S::gabled, "gabled"}},
      {"triple_skillion", {S::skillion, "skillion"}},
      {"sloped", {S::skillion, "skillion"}},
      {"cross_hipped", {S::hipped, "hipped"}},
      {"zakopane", {S::hipped, "hipped"}},
      {"pagoda", {S::hipped, "hipped"}},
      {"curved", {S::round, "round"}},
      {"semi_round", {S::round, "round"}},
      {"half_round", {S::round, "round"}},
      {"spire", {S::pyramidal, "pyramidal"}},
      {"helm", {S::pyramidal, "pyramidal"}},
      {"half_dome", {S::dome, "dome"}},
      {"cupola", {S::dome, "dome"}},
      {"bell", {S::dome, "dome"}},
      {"spherical", {S::dome, "dome"}}};
  return table;
}

std::string find_text(const osm::OsmTags& tags) {
  for (const char* key : {"roof:shape", "building:roof:shape"}) {
    const auto found = tags.find(key);
    if (found == tags.end()) continue;
    std::string text = osm::normalise_tag(found->second);
    // A list names the shape of most of the roof first.
    if (const auto parts = osm::split_list(text); parts.size() > 1)
      text = osm::normalise_tag(parts.front());
    if (!text.empty()) return text;
  }
  return {};
}

}  // namespace

RoofShape find_roof_shape(const osm::OsmTags& tags, city::SkipCounter& notes) {
  const std::string text = find_text(tags);
  if (const auto known = shapes().find(text); known != shapes().end()) return known->second;
  if (const auto near = nearest_shapes().find(text); near != nearest_shapes().end()) {
    notes.add("roof:shape=" + text + ", shown as " + near->second.name);
    return near->second.shape;
  }
  notes.add("roof:shape=" + text + ", shown flat");
  return S::flat;
}

}  // namespace nightcity::map_buildings
