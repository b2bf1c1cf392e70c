#include "tools/osm/arranged_map.h"

#include <osmium/builder/osm_object_builder.hpp>
#include <osmium/osm/object_comparisons.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/osm/osm_document.h"
#include "tools/osm/whole_tags.h"

namespace nightcity::osm {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;  // to begin with
constexpr std::size_t max_text_bytes = 1024;                // of a key, a value or a role

struct Element {
  std::int64_t id;
  OsmVersion version;
  pugi::xml_node node;
};

/// Lists the elements of a name in osmium's order of ids, each in its newest version, of equal ones
/// the first, without those that are deleted.
std::vector<Element> list_elements(const pugi::xml_node& root, const char* name) {
  std::vector<Element> all;
  for (const pugi::xml_node& node : root.children(name))
    if (const auto id = to_number<std::int64_t>(node.attribute("id").value())) {
      require_sound_id(*id);
      all.push_back({*id, read_version(node), node});
    }
  std::stable_sort(all.begin(), all.end(), [](const Element& a, const Element& b) {
    if (a.id != b.id) return osmium::id_order{}(a.id, b.id);
    return a.version.rank() > b.version.rank();
  });
  all.erase(std::unique(all.begin(), all.end(),
                        [](const Element& a, const Element& b) { return a.id == b.id; }),
            all.end());
  std::erase_if(all, [](const Element& element) { return element.version.deleted; });
  return all;
}

osmium::Location to_location(const glm::dvec2& place) {
  osmium::Location location;
  if (std::abs(place.x) <= 180 && std::abs(place.y) <= 90)
    location.set_lon(place.x).set_lat(place.y);
  return location;
}

class Arranger {
 public:
  explicit Arranger(const pugi::xml_node& root)
      : ways_(list_elements(root, "way")), relations_(list_elements(root, "relation")) {
    for (const Element& node : list_elements(root, "node"))
      if (const auto place = to_location(read_place(node.node)); place.valid())
        places_.emplace(node.id, place);
  }

  ArrangedMap arrange() {
    using osmium::memory::Buffer;
    ArrangedMap map{Buffer(buffer_bytes, Buffer::auto_grow::yes),
                    Buffer(buffer_bytes, Buffer::auto_grow::yes)};
    find_members_places();
    // Ways of the file and those of relations alone, by id.
    auto own = ways_.begin();
    for (const std::int64_t id : list_way_ids()) {
      while (own != ways_.end() && osmium::id_order{}(own->id, id)) ++own;
      const bool is_own = own != ways_.end() && own->id == id;
      add_way(map.ways, id, is_own ? &*own : nullptr);
    }
    for (const Element& relation : relations_) add_relation(map.relations, relation);
    return map;
  }

 private:
  using Nodes = std::vector<osmium::NodeRef>;

  Nodes find_nodes(const Element& way) const {
    Nodes nodes;
    for (const pugi::xml_node& nd : way.node.children("nd")) {
      const auto id = to_number<std::int64_t>(nd.attribute("ref").value()).value_or(INT64_MIN);
      const auto known = places_.find(id);
      nodes.emplace_back(id, known == places_.end() ? to_location(read_place(nd)) : known->second);
    }
    return nodes;
  }

  // Overpass gives the members of relations the places of their nodes, but no ids.
  void find_members_places() {
    for (const Element& relation : relations_)
      for (const pugi::xml_node& member : relation.node.children("member")) {
        const auto id = to_number<std::int64_t>(member.attribute("ref").value());
        if (!id || std::string_view(member.attribute("type").value()) != "way" ||
            !member.child("nd"))
          continue;
        require_sound_id(*id);
        Nodes& nodes = of_members_[*id];
        if (!nodes.empty()) continue;
        for (const pugi::xml_node& nd : member.children("nd")) {
          const osmium::Location place = to_location(read_place(nd));
          nodes.emplace_back(id_at(place), place);
        }
      }
  }

  std::int64_t id_at(const osmium::Location& place) {
    constexpr std::int64_t first = std::int64_t{1} << 62;  // beyond those that OpenStreetMap has
    const auto next = first + static_cast<std::int64_t>(ids_.size());
    return ids_.try_emplace(std::pair(place.x(), place.y()), next).first->second;
  }

  std::vector<std::int64_t> list_way_ids() const {
    std::vector<std::int64_t> ids;
    for (const Element& way : ways_) ids.push_back(way.id);
    for (const auto& [id, nodes] : of_members_) ids.push_back(id);
    std::sort(ids.begin(), ids.end(), osmium::id_order{});
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  void add_way(osmium::memory::Buffer& out, std::int64_t id, const Element* own) {
    Nodes nodes = own ? find_nodes(*own) : Nodes();
    const auto is_placed = [](const osmium::NodeRef& node) { return node.location().valid(); };
    const auto of_member = of_members_.find(id);
    if (of_member != of_members_.end() &&
        (nodes.empty() || !std::all_of(nodes.begin(), nodes.end(), is_placed)))
      nodes = of_member->second;
    {
      osmium::builder::WayBuilder builder(out);
      builder.set_id(id).set_version(own ? own->version.number : 1).set_visible(true);
      if (own) add_tags(out, builder, own->node);
      osmium::builder::WayNodeListBuilder list(out, &builder);
      for (const osmium::NodeRef& node : nodes) list.add_node_ref(node);
    }
    out.commit();
  }

  static void add_relation(osmium::memory::Buffer& out, const Element& relation) {
    {
      osmium::builder::RelationBuilder builder(out);
      builder.set_id(relation.id).set_version(relation.version.number).set_visible(true);
      add_tags(out, builder, relation.node);
      osmium::builder::RelationMemberListBuilder list(out, &builder);
      for (const pugi::xml_node& member : relation.node.children("member")) {
        const std::string_view type = member.attribute("type").value();
        const auto id = to_number<std::int64_t>(member.attribute("ref").value());
        std::string_view role = member.attribute("role").value();
        if (role.size() > max_text_bytes) role = {};
        if (!id || (type != "way" && type != "node" && type != "relation")) continue;
        list.add_member(type == "way"    ? osmium::item_type::way
                        : type == "node" ? osmium::item_type::node
                                         : osmium::item_type::relation,
                        *id, role.data(), role.size());
      }
    }
    out.commit();
  }

  static void add_tags(osmium::memory::Buffer& out, osmium::builder::Builder& builder,
                       const pugi::xml_node& element) {
    osmium::builder::TagListBuilder list(out, &builder);
    for (const pugi::xml_node& tag : element.children("tag")) {
      const std::string_view key = tag.attribute("k").value(), value = tag.attribute("v").value();
      if (key.size() <= max_text_bytes && value.size() <= max_text_bytes)
        list.add_tag(key.data(), key.size(), value.data(), value.size());
    }
  }

  std::vector<Element> ways_, relations_;
  std::unordered_map<std::int64_t, osmium::Location> places_;
  std::unordered_map<std::int64_t, Nodes> of_members_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> ids_;
};

}  // namespace

ArrangedMap arrange_map(const pugi::xml_node& root) {
  return Arranger(root).arrange();
}

}  // namespace nightcity::osm
