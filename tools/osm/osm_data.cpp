#include "tools/osm/osm_data.h"

#include <algorithm>
#include <iterator>
#include <unordered_set>
#include <utility>

namespace nightcity {
namespace {

// Removes elements whose id was seen before; returns how many.
template <class Element>
std::size_t remove_repeated(std::vector<Element>& elements,
                            std::unordered_set<std::int64_t>& seen) {
  const auto kept = std::remove_if(elements.begin(), elements.end(), [&](const Element& element) {
    return !seen.insert(element.id).second;
  });
  const auto removed = static_cast<std::size_t>(elements.end() - kept);
  elements.erase(kept, elements.end());
  return removed;
}

// Appends elements whose id is new; returns how many are not.
template <class Element>
std::size_t append_new(std::vector<Element>& to, std::vector<Element>&& from) {
  std::unordered_set<std::int64_t> seen;
  for (const Element& element : to) seen.insert(element.id);
  const std::size_t removed = remove_repeated(from, seen);
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  return removed;
}

}  // namespace

void OsmData::merge(OsmData&& other) {
  duplicates += other.duplicates;
  duplicates += append_new(lamps, std::move(other.lamps));
  duplicates += append_new(highways, std::move(other.highways));
  duplicates += append_new(buildings, std::move(other.buildings));
  nodes += other.nodes;
  ways += other.ways;
  relations += other.relations;
  missing_nodes += other.missing_nodes;
  bad_coordinates += other.bad_coordinates;
}

}  // namespace nightcity
