#include "tools/cityjson/feature_reader.h"

#include <tuple>
#include <utility>

#include "formats/error.h"
#include "tools/city/merge_parts.h"
#include "tools/cityjson/object_groups.h"

namespace nightcity::cityjson {
namespace {

std::vector<std::string_view> list_children(const dom::object& object) {
  std::vector<std::string_view> ids;
  if (const auto children = find_array(object, "children"))
    for (const dom::element& child : *children)
      if (std::string_view id; child.get(id) == simdjson::SUCCESS) ids.push_back(id);
  return ids;
}

// CityJSON 1.0's drafts knew one "parent".
std::string_view find_parent(const dom::object& object) {
  std::string_view id;
  if (const auto parents = find_array(object, "parents"); parents && parents->size() > 0)
    std::ignore = parents->at(0).get(id);
  return id.empty() ? find_text(object, "parent") : id;
}

}  // namespace

void Batch::read(std::span<const GroupMember> group, const GeometrySources& sources,
                 const city::ReadOptions& options) {
  std::optional<city::RawObject> raw = read_object(group, sources, skipped);
  if (raw && raw->left_out) return city::count_left_out(*raw, skipped);
  if (raw) objects.push_back(city::merge_parts(std::move(*raw), options, report));
}

void Batch::hand_over(const city::ObjectStage& stage) {
  if (!objects.empty()) rest = stage(std::exchange(objects, {}));
}

void Batch::take_into(city::ReadReport& file) {
  if (rest) rest();
  skipped.merge_into(report.skipped);
  file.merge(report);
}

void read_feature(const dom::element& value, const SharedParts& shared,
                  const city::ReadOptions& options, const std::string& name, std::size_t line,
                  Batch& batch) {
  dom::object feature;
  if (value.get(feature) != simdjson::SUCCESS)
    throw Error(name, line, "is no CityJSONFeature: it is no JSON object");
  const std::string_view type = find_text(feature, "type");
  if (type == "CityJSON" && line > 1)
    throw Error(name, line,
                "a second \"CityJSON\" in one file: each has a transform of its own, so name the "
                "files apart");
  if (type != "CityJSONFeature" && type != "CityJSON")
    throw Error(name, line, "is no CityJSONFeature: its \"type\" is \"" + std::string(type) + "\"");
  const auto objects = find_object(feature, "CityObjects");
  if (!objects) return batch.skipped.add("feature without city objects");

  std::vector<glm::dvec3> vertices;
  // The header's holds for all, but some writers give each feature one of its own.
  const auto own_transform = find_member(feature, "transform");
  const Transform transform =
      own_transform && !own_transform->is_null() && line > 1
          ? read_transform(*own_transform, [&] { return name + ":" + std::to_string(line); })
          : shared.transform;
  if (const auto array = find_array(feature, "vertices"))
    vertices = read_vertices(*array, transform);
  Materials own;
  GeometrySources sources{vertices, are_usable(vertices), &shared, &shared.materials};
  if (const auto appearance = find_object(feature, "appearance"); appearance && line > 1) {
    own.read(*appearance);
    own.find_pictures(name, options, batch.skipped);
    sources.materials = &own;
  }
  std::vector<ObjectNode> nodes;
  std::vector<dom::object> parsed;
  for (const auto& [id, element] : *objects) {
    dom::object object;
    if (element.get(object) != simdjson::SUCCESS) {
      batch.skipped.add("city object that is no object");
      continue;
    }
    nodes.push_back({id, find_object_class(find_text(object, "type")), list_children(object),
                     find_parent(object)});
    parsed.push_back(object);
  }
  const ObjectGroups groups = group_objects(nodes, batch.skipped);
  std::vector<GroupMember> group;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    group.clear();
    for (const std::uint32_t n : groups.group(i))
      group.push_back({nodes[n].id, nodes[n].what, parsed[n]});
    batch.read(group, sources, options);
  }
}

}  // namespace nightcity::cityjson
