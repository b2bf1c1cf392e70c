#include "tools/osm/lamp_relations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>

#include "tools/osm/kind_keys.h"
#include "tools/osm/mean_place.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

// A lamp hangs on these; whatever else a member says that it is, it is no lamp.
bool may_carry_lamp(const OsmTags& tags) {
  if (is_lamp(tags)) return true;
  constexpr std::array<std::string_view, 5> posts{"pole", "utility_pole", "mast", "lamp_post",
                                                  "portal"};
  return std::all_of(kind_keys.begin(), kind_keys.end(), [&](std::string_view key) {
    const std::string value = find_tag(tags, std::string(key));
    return value.empty() || std::find(posts.begin(), posts.end(), value) != posts.end();
  });
}

bool is_lamp_role(std::string_view role) {
  constexpr std::array<std::string_view, 9> others{"inner",        "perimeter", "label",
                                                   "admin_centre", "entrance",  "cabinet",
                                                   "controller",   "feeder",    "subarea"};
  return std::find(others.begin(), others.end(), normalise_tag(role)) == others.end();
}

bool is_multipolygon(const OsmTags& tags) {
  return find_tag(tags, "type") == "multipolygon";
}

OsmTags drop_type(OsmTags tags) {
  for (const char* key : {"type", "site"}) tags.erase(key);
  return tags;
}

}  // namespace

void LampRelations::add(const Key& key, OsmVersion version, OsmRelation relation) {
  if (!is_lamp(relation.tags)) relation = {};
  relations_.push_back({key, version.rank(), version.deleted, std::move(relation)});
}

bool LampRelations::choose() {
  std::stable_sort(relations_.begin(), relations_.end(), [](const Relation& a, const Relation& b) {
    return std::tie(a.key, b.rank) < std::tie(b.key, a.rank);
  });
  relations_.erase(std::unique(relations_.begin(), relations_.end(),
                               [](const Relation& a, const Relation& b) { return a.key == b.key; }),
                   relations_.end());
  std::erase_if(relations_, [](const Relation& relation) {
    return relation.deleted || !is_lamp(relation.content.tags);
  });
  for (const Relation& relation : relations_)
    for (const OsmMember& member : relation.content.members)
      if (member.type != OsmMember::Type::relation)
        members_[{member.type, key_of(member.id, relation.key.second)}];
  return !relations_.empty();
}

void LampRelations::add_member(const MemberKey& key, OsmVersion version, Member member) {
  const auto known = members_.find(key);
  if (known == members_.end()) return;
  member.rank = version.rank();
  member.deleted = version.deleted;
  if (!known->second.rank || *known->second.rank < *member.rank) known->second = std::move(member);
}

void LampRelations::add_node(std::int64_t id, std::uint32_t file, OsmVersion version,
                             OsmTags tags) {
  add_member({OsmMember::Type::node, key_of(id, file)}, version,
             {{}, false, {{id}}, std::move(tags)});
}

void LampRelations::add_way(std::int64_t id, std::uint32_t file, OsmVersion version,
                            std::vector<OsmNodeRef> nodes, OsmTags tags) {
  add_member({OsmMember::Type::way, key_of(id, file)}, version,
             {{}, false, std::move(nodes), std::move(tags)});
}

// Open outer ways of a multipolygon are one ring together; every other member stands for itself.
std::vector<LampRelations::Group> LampRelations::find_groups(const Relation& relation) const {
  const bool is_area = is_multipolygon(relation.content.tags);
  std::vector<Group> groups;
  Group ring;
  for (const OsmMember& member : relation.content.members) {
    if (!is_lamp_role(member.role) || member.type == OsmMember::Type::relation ||
        (is_area && member.type == OsmMember::Type::node))
      continue;
    const Member& known = members_.at({member.type, key_of(member.id, relation.key.second)});
    if (known.deleted || (!is_area && !may_carry_lamp(known.tags))) continue;
    const bool is_open = known.nodes.size() > 1 ? known.nodes.front().id != known.nodes.back().id
                                                : member.places.empty() ||
                                                      member.places.front() != member.places.back();
    if (is_area && is_open)
      ring.emplace_back(&member, &known);
    else
      groups.push_back({{&member, &known}});
  }
  if (!ring.empty()) groups.push_back(std::move(ring));
  return groups;
}

std::optional<glm::dvec2> LampRelations::find_middle(const Group& group, std::uint32_t file,
                                                     const FindPlace& find_place) {
  std::vector<glm::dvec2> places;
  std::set<std::pair<double, double>> seen;
  const auto add = [&](const glm::dvec2& place) {
    if (std::isfinite(place.x) && std::isfinite(place.y) && seen.emplace(place.x, place.y).second)
      places.push_back(place);
  };
  for (const auto& [member, known] : group) {
    for (const OsmNodeRef& node : known->nodes)
      add(find_place(key_of(node.id, file)).value_or(node.lon_lat));
    if (places.empty())
      for (const glm::dvec2& place : member->places) add(place);
  }
  if (places.empty()) return std::nullopt;
  return find_mean_place(places);
}

std::vector<OsmLampNode> LampRelations::place(
    const FindPlace& find_place,
    const std::function<void(const OsmMember&, const Key&, const OsmTags&)>& complete,
    std::size_t& without_place) const {
  std::vector<OsmLampNode> lamps;
  std::map<MemberKey, bool> tried;  // by the first members: whether they have a place
  for (const Relation& relation : relations_) {
    const OsmTags of_relation = drop_type(relation.content.tags);
    const std::uint32_t file = relation.key.second;
    bool is_there = false;
    for (const Group& group : find_groups(relation)) {
      const auto& [first, known] = group.front();
      const auto own = std::find_if(group.begin(), group.end(),
                                    [](const auto& one) { return is_lamp(one.second->tags); });
      if (own != group.end()) {
        complete(*own->first, key_of(own->first->id, file), of_relation);
        is_there = true;
        continue;
      }
      const auto [known_place, is_new] =
          tried.try_emplace({first->type, key_of(first->id, file)}, false);
      if (!is_new) {
        is_there = is_there || known_place->second;
        continue;
      }
      const auto middle = find_middle(group, file, find_place);
      if (!middle) continue;
      is_there = known_place->second = true;
      OsmLampNode lamp{first->id, *middle,
                       is_multipolygon(relation.content.tags) ? OsmTags() : known->tags,
                       first->type == OsmMember::Type::way};
      lamp.tags.insert(of_relation.begin(), of_relation.end());
      for (const char* key : {"highway", "man_made"})
        if (const auto says = of_relation.find(key); says != of_relation.end())
          lamp.tags[key] = says->second;
      lamps.push_back(std::move(lamp));
    }
    if (!is_there && relation.content.centre) {
      lamps.push_back({relation.key.first, *relation.content.centre, of_relation, true});
      is_there = true;
    }
    without_place += !is_there;
  }
  return lamps;
}

}  // namespace nightcity::osm
