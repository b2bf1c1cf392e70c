#include "tools/osm/repeated_things.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <unordered_map>
#include <vector>

#include "tools/osm/place_steps.h"
#include "tools/random.h"

namespace nightcity::osm {
namespace {

using Keys = std::initializer_list<const char*>;

// A line is the same in either direction, a ring from any of its places on.
std::uint64_t hash_line(const std::vector<glm::dvec2>& line) {
  std::uint64_t forward = line.size(), backward = line.size(), ring = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    forward = mix(forward ^ hash_place(round_to_steps(line[i])));
    backward = mix(backward ^ hash_place(round_to_steps(line[line.size() - 1 - i])));
    if (i > 0) ring += hash_place(round_to_steps(line[i]));
  }
  const bool is_closed = line.size() > 2 && line.front() == line.back();
  return is_closed ? mix(ring) : std::min(forward, backward);
}

std::uint64_t hash_tags(const OsmTags& tags, Keys keys) {
  std::uint64_t hash = 0;
  for (const char* key : keys) {
    const auto found = tags.find(key);
    hash = mix(hash ^ (found == tags.end() ? 0 : hash_text(found->second)));
  }
  return hash;
}

// A hash of 64 bits tells all things of a map apart.
template <class Thing, class HashPlace>
std::size_t leave_out(std::vector<Thing>& things, Keys keys, HashPlace hash_place_of) {
  std::unordered_map<std::uint64_t, std::size_t> best;
  std::vector<std::uint64_t> hashes;
  for (std::size_t i = 0; i < things.size(); ++i) {
    hashes.push_back(mix(hash_tags(things[i].tags, keys)) ^ hash_place_of(things[i]));
    const auto [known, is_new] = best.try_emplace(hashes.back(), i);
    if (!is_new && things[i].tags.size() > things[known->second].tags.size()) known->second = i;
  }
  std::size_t n = 0;
  return std::erase_if(things, [&](const Thing&) {
    const std::size_t i = n++;
    return best.at(hashes[i]) != i;
  });
}

}  // namespace

std::size_t leave_out_repeated(OsmData& map) {
  const auto of_line = [](const auto& thing) { return hash_line(thing.lon_lat); };
  // Signs at one node may face several ways.
  const auto of_area = [](const OsmShiningThing& thing) {
    return thing.is_way ? hash_line(thing.lon_lat) : mix(static_cast<std::uint64_t>(thing.id));
  };
  return leave_out(map.highways,
                   {"highway", "area", "layer", "level", "tunnel", "bridge", "covered", "oneway"},
                   of_line) +
         leave_out(map.railways, {"railway", "layer", "level", "tunnel", "bridge"}, of_line) +
         leave_out(map.watercourses, {"waterway", "natural", "layer", "tunnel"}, of_line) +
         leave_out(map.barriers, {"barrier", "layer", "level", "min_height"}, of_line) +
         leave_out(map.tree_rows, {"layer"}, of_line) +
         leave_out(map.shining_things,
                   {"leisure", "amenity", "building", "historic", "man_made", "advertising",
                    "tourism", "layer", "level", "min_height"},
                   of_area) +
         leave_out(map.trees, {"layer", "level"},
                   [](const OsmPoint& tree) { return hash_place(round_to_steps(tree.lon_lat)); });
}

}  // namespace nightcity::osm
