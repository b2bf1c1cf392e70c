#include "tools/osm/building_relations.h"

#include <osmium/builder/osm_object_builder.hpp>

#include <cstddef>
#include <cstring>

namespace nightcity::osm {

bool is_building_relation(const osmium::Relation& relation) {
  const char* const type = relation.tags().get_value_by_key("type");
  return type && std::strcmp(type, "building") == 0 && relation.tags().has_key("building");
}

osmium::memory::Buffer make_outline_multipolygon(const osmium::Relation& relation) {
  constexpr std::size_t first_bytes = 1024;
  osmium::memory::Buffer buffer(first_bytes, osmium::memory::Buffer::auto_grow::yes);
  {
    osmium::builder::RelationBuilder builder(buffer);
    builder.set_id(relation.id());
    builder.set_version(relation.version());
    builder.set_visible(relation.visible());
    {
      osmium::builder::TagListBuilder tags(builder);
      for (const osmium::Tag& tag : relation.tags()) {
        const bool is_type = std::strcmp(tag.key(), "type") == 0;
        tags.add_tag(tag.key(), is_type ? "multipolygon" : tag.value());
      }
    }
    osmium::builder::RelationMemberListBuilder members(builder);
    for (const osmium::RelationMember& member : relation.members()) {
      const char* const role = member.role();
      const bool is_outline = std::strcmp(role, "outline") == 0 || std::strcmp(role, "outer") == 0;
      if (is_outline || std::strcmp(role, "inner") == 0)
        members.add_member(member.type(), member.ref(), is_outline ? "outer" : role);
    }
  }
  buffer.commit();
  return buffer;
}

}  // namespace nightcity::osm
