#include "tools/cityjson/object_groups.h"

#include <unordered_map>
#include <unordered_set>

namespace nightcity::cityjson {
namespace {

bool is_second_level(ObjectRole role) {
  return role == ObjectRole::part || role == ObjectRole::detail || role == ObjectRole::interior;
}

using Children = std::unordered_map<std::string_view, std::vector<std::uint32_t>>;

// Returns, by their parents' ids, children that no parent names though they name it: each should
// name the other, and some writers fill in one of the two.
Children find_unnamed_children(std::span<const ObjectNode> nodes) {
  std::unordered_set<std::string_view> named;
  for (const ObjectNode& node : nodes) named.insert(node.children.begin(), node.children.end());
  Children unnamed;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    if (is_second_level(nodes[i].what.role) && !nodes[i].parent.empty() &&
        !named.contains(nodes[i].id))
      unnamed[nodes[i].parent].push_back(i);
  return unnamed;
}

}  // namespace

ObjectGroups group_objects(std::span<const ObjectNode> nodes, city::SkipCounter& skipped) {
  std::unordered_map<std::string_view, std::uint32_t> second_level;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    if (is_second_level(nodes[i].what.role)) second_level.emplace(nodes[i].id, i);
  const Children unnamed = find_unnamed_children(nodes);
  ObjectGroups groups;
  groups.objects.reserve(nodes.size());
  std::vector<bool> taken(nodes.size());
  const auto take = [&](std::uint32_t child) {
    if (taken[child]) return;
    taken[child] = true;
    groups.objects.push_back(child);
  };
  const auto add_group = [&](std::uint32_t root) {
    groups.first.push_back(static_cast<std::uint32_t>(groups.objects.size()));
    taken[root] = true;
    groups.objects.push_back(root);
    for (std::size_t at = groups.first.back(); at < groups.objects.size(); ++at) {
      const ObjectNode& node = nodes[groups.objects[at]];
      if (node.what.role == ObjectRole::group || node.what.role == ObjectRole::unknown) continue;
      for (const std::string_view id : node.children) {
        const auto child = second_level.find(id);
        if (child == second_level.end())
          skipped.add("child that is not in the file");
        else
          take(child->second);
      }
      if (const auto more = unnamed.find(node.id); more != unnamed.end())
        for (const std::uint32_t child : more->second) take(child);
    }
  };
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    if (!is_second_level(nodes[i].what.role)) add_group(i);
  // A part whose parent is in another file or of an extension still stands.
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    if (!taken[i]) add_group(i);
  return groups;
}

}  // namespace nightcity::cityjson
