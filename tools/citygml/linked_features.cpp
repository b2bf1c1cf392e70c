#include "tools/citygml/linked_features.h"

#include <sstream>
#include <utility>

#include "formats/percent_text.h"
#include "tools/city/attributes.h"
#include "tools/citygml/citygml_schema.h"
#include "tools/citygml/geometry_walk.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {
namespace {

bool is_address(std::string_view name) {
  return name == "Address";
}

// Returns whether a feature may be a part of another one.
bool is_dependent(std::string_view name) {
  const ClassKind kind = find_feature_class(name).kind;
  return kind == ClassKind::part || kind == ClassKind::detail || kind == ClassKind::surface ||
         is_address(name);
}

bool is_feature(std::string_view name) {
  return find_feature_class(name).kind != ClassKind::unknown || is_address(name);
}

// Calls `visit` for the features that stand in a member, in collections too, but not for those
// inside of them.
template <class Visit>
void visit_objects(const pugi::xml_node& node, const Visit& visit, int depth = 0) {
  if (node.type() == pugi::node_element && is_feature(local_name(node.name()))) {
    visit(node);
    return;
  }
  if (depth > max_nesting) return;
  for (const pugi::xml_node& child : node.children())
    if (child.type() == pugi::node_element) visit_objects(child, visit, depth + 1);
}

// Calls `visit` for each property of a feature, and of those inside it, that links to a feature.
template <class Visit>
void visit_links(const pugi::xml_node& feature, const Visit& visit, int depth = 0) {
  // The members of a group are objects of their own.
  if (depth > max_nesting || local_name(feature.name()) == "CityObjectGroup") return;
  for (pugi::xml_node property = feature.first_child(); property;) {
    const pugi::xml_node here = property;
    property = property.next_sibling();  // the visitor may take it away
    if (here.type() != pugi::node_element) continue;
    const PropertyKind kind = find_property_kind(local_name(here.name()));
    if (kind != PropertyKind::features && kind != PropertyKind::address) continue;
    if (!here.first_child()) {
      if (!find_attribute(here, "href").empty()) visit(here);
      continue;
    }
    for (const pugi::xml_node& child : here.children())
      if (child.type() == pugi::node_element) visit_links(child, visit, depth + 1);
  }
}

// Returns the name of what a property links to; "" where it lies outside the city.
std::string name_target(const pugi::xml_node& property, const GeometryLibrary& library) {
  const std::string_view href = city::trim(find_attribute(property, "href"));
  if (!library.is_in_document(href)) return library.name_elsewhere(href);
  return decode_percent(city::trim(href.substr(href.find('#') + 1)));
}

std::string id_of(const pugi::xml_node& node) {
  return std::string(city::trim(find_attribute(node, "id")));
}

}  // namespace

FeatureLinks take_feature_links(pugi::xml_node member, bool has_links,
                                const GeometryLibrary& library) {
  FeatureLinks found;
  IdIndex ids(member);
  std::size_t objects = 0;
  visit_objects(member, [&](const pugi::xml_node& object) {
    if (++objects == 1 && is_dependent(local_name(object.name()))) found.lone_id = id_of(object);
    if (!has_links) return;
    visit_links(object, [&](pugi::xml_node link) {
      std::string name = name_target(link, library);
      if (name.empty()) return;
      if (ids.find(name))
        link.parent().remove_child(link);
      else
        found.names.push_back(std::move(name));
    });
  });
  if (objects != 1) found.lone_id.clear();
  return found;
}

std::vector<std::string> LinkedFeatures::list_wanted() const {
  std::unordered_set<std::string> names;
  for (const FeatureLinks& links : links_) names.insert(links.names.begin(), links.names.end());
  return {names.begin(), names.end()};
}

void LinkedFeatures::fetch(const pugi::xml_node& feature, bool stands_alone,
                           const std::string& name, const GeometryLibrary& library) {
  const auto [at, is_new] = features_.try_emplace(name);
  if (!is_new) return;
  const std::string_view kind = local_name(feature.name());
  if (!stands_alone || !is_dependent(kind)) return;
  std::ostringstream text;
  feature.print(text, "", pugi::format_raw);
  constexpr std::size_t max_shared_bytes = 10'000;  // it may be copied into every building
  Feature& taken = at->second;
  taken.text = std::move(text).str();
  taken.may_be_shared = is_address(kind) && taken.text.size() <= max_shared_bytes;
  if (taken.text.size() > room_) {
    taken.text.clear();
    ++beyond_room_;
    return;
  }
  room_ -= taken.text.size();
  visit_links(feature, [&](const pugi::xml_node& link) {
    if (std::string target = name_target(link, library); !target.empty())
      taken.names.push_back(std::move(target));
  });
}

void LinkedFeatures::fetch_from(const pugi::xml_node& member,
                                const std::unordered_set<std::string>& wanted,
                                const std::string& prefix, const GeometryLibrary& library) {
  visit_objects(member, [&](const pugi::xml_node& object) {
    if (const std::string id = id_of(object); wanted.contains(id)) {
      fetch(object, true, prefix + id, library);
      features_[prefix + id].is_elsewhere = !prefix.empty();
    }
  });
  struct Inside : pugi::xml_tree_walker {
    const std::unordered_set<std::string>* wanted;
    std::vector<std::string> found;
    bool for_each(pugi::xml_node& node) override {
      if (std::string id = id_of(node); !id.empty() && wanted->contains(id))
        found.push_back(std::move(id));
      return true;
    }
  } inside;
  inside.wanted = &wanted;
  pugi::xml_node(member).traverse(inside);
  for (const std::string& id : inside.found) fetch(member, false, prefix + id, library);
}

void LinkedFeatures::assign() {
  const std::vector<std::string> names = list_wanted();
  const std::unordered_set<std::string> wanted(names.begin(), names.end());
  std::unordered_map<std::string, std::size_t> members;  // by the id that each has
  for (const FeatureLinks& links : links_)
    if (!links.lone_id.empty()) members.emplace(links.lone_id, links.member);
  for (const FeatureLinks& links : links_) {
    // A part that another links to gets nothing of its own: that one takes both.
    if (wanted.contains(links.lone_id)) continue;
    std::vector<std::string> open(links.names.rbegin(), links.names.rend());
    while (!open.empty()) {
      const std::string name = std::move(open.back());
      open.pop_back();
      const auto feature = features_.find(name);
      if (feature == features_.end() || feature->second.text.empty()) continue;
      if (!owners_.emplace(name, links.member).second) continue;
      if (const auto at = members.find(name); at != members.end()) given_away_.insert(at->second);
      open.insert(open.end(), feature->second.names.rbegin(), feature->second.names.rend());
    }
  }
}

std::vector<std::string> LinkedFeatures::put_into(pugi::xml_node member, std::size_t number,
                                                  const GeometryLibrary& library) const {
  std::vector<std::string> from_elsewhere;
  std::unordered_set<std::string> put;
  std::vector<pugi::xml_node> open;
  visit_objects(member, [&](const pugi::xml_node& object) { open.push_back(object); });
  while (!open.empty()) {
    const pugi::xml_node object = open.back();
    open.pop_back();
    visit_links(object, [&](pugi::xml_node link) {
      const std::string name = name_target(link, library);
      const auto feature = features_.find(name);
      if (feature == features_.end()) return;
      const auto owner = owners_.find(name);
      const bool is_own =
          feature->second.may_be_shared || (owner != owners_.end() && owner->second == number);
      pugi::xml_document copy;
      if (!is_own || !put.insert(name).second ||
          !copy.load_buffer(feature->second.text.data(), feature->second.text.size(),
                            gml_parse_flags, pugi::encoding_utf8)) {
        link.parent().remove_child(link);
        return;
      }
      open.push_back(link.append_copy(copy.document_element()));
      if (feature->second.is_elsewhere) from_elsewhere.push_back(id_of(open.back()));
    });
  }
  take_feature_links(member, true, library);  // of those within what has been put in
  return from_elsewhere;
}

}  // namespace nightcity::citygml
