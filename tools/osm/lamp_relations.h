// Lamps that a map has as relations: areas of several ways, and sites whose members are the lamps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tools/osm/osm_data.h"
#include "tools/osm/osm_elements.h"

namespace nightcity::osm {

/// A relation comes behind its members in a map, and most ways that have no tags are not kept. So
/// where there are such relations, the maps are read once more, for their members alone.
class LampRelations {
 public:
  /// An id, and the number of the file where it is negative: an editor's own.
  using Key = std::pair<std::int64_t, std::uint32_t>;
  using FindPlace = std::function<std::optional<glm::dvec2>(const Key& node)>;

  /// Takes each relation of the maps: a newer version may be no lamp any more.
  void add(const Key& key, OsmVersion version, OsmRelation relation);
  /// Drops older versions and returns whether there are any lamps.
  bool choose();

  /// Take each element on the second reading, `file` as in Key.
  void add_node(std::int64_t id, std::uint32_t file, OsmVersion version, OsmTags tags);
  void add_way(std::int64_t id, std::uint32_t file, OsmVersion version,
               std::vector<OsmNodeRef> nodes, OsmTags tags);

  /// Returns a lamp for each ring of a multipolygon, in its middle, and for each member of another
  /// relation, unless these are lamps themselves: to those, `complete` gives the relation's tags.
  /// Counts in `without_place` the relations of which nothing is there.
  std::vector<OsmLampNode> place(
      const FindPlace& find_place,
      const std::function<void(const OsmMember&, const Key&, const OsmTags&)>& complete,
      std::size_t& without_place) const;

 private:
  struct Relation {
    Key key;
    std::uint32_t rank;
    bool deleted;
    OsmRelation content;
  };
  struct Member {
    std::optional<std::uint32_t> rank;  // none: the maps do not have it
    bool deleted = false;
    std::vector<OsmNodeRef> nodes;
    OsmTags tags;
  };
  using MemberKey = std::pair<OsmMember::Type, Key>;
  using Group = std::vector<std::pair<const OsmMember*, const Member*>>;

  static Key key_of(std::int64_t id, std::uint32_t file) { return {id, id < 0 ? file : 0}; }
  void add_member(const MemberKey& key, OsmVersion version, Member member);
  std::vector<Group> find_groups(const Relation& relation) const;
  static std::optional<glm::dvec2> find_middle(const Group& group, std::uint32_t file,
                                               const FindPlace& find_place);

  std::vector<Relation> relations_;
  std::map<MemberKey, Member> members_;
};

}  // namespace nightcity::osm
