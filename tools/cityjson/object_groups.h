// Groups city objects that make one: a building with its parts and installations.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "tools/city/skip_counter.h"
#include "tools/cityjson/cityjson_types.h"

namespace nightcity::cityjson {

struct ObjectNode {
  std::string_view id;
  ObjectClass what;
  std::vector<std::string_view> children;  // ids
  std::string_view parent{};               // the first of its parents; "" = none
};

/// Lists of numbers of objects, one behind the other.
struct ObjectGroups {
  std::vector<std::uint32_t> objects;
  std::vector<std::uint32_t> first;  // of each group, into `objects`

  std::size_t size() const { return first.size(); }
  std::span<const std::uint32_t> group(std::size_t number) const {
    const std::size_t begin = first[number];
    const std::size_t end = number + 1 < first.size() ? first[number + 1] : objects.size();
    return std::span(objects).subspan(begin, end - begin);
  }
};

/// Groups objects with their children and the children's children, each group led by its own
/// 1st-level object, in the order of the file. A child belongs to the first that names it,
/// or, where none does, to the parent that it names itself. Other 2nd-level objects come last, as
/// groups of their own. Children that are not among
/// `nodes` are counted.
ObjectGroups group_objects(std::span<const ObjectNode> nodes, city::SkipCounter& skipped);

}  // namespace nightcity::cityjson
