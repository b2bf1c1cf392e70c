// A check of what libosmium hands over, for the few files that include it.
#pragma once

#include <osmium/handler.hpp>
#include <osmium/osm/object.hpp>
#include <osmium/osm/tag.hpp>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace nightcity::osm {

/// Throws where going through `tags` would lead beyond their end. libosmium keeps keys and values
/// as texts that end with a zero byte, one behind the other, and takes texts with zero bytes in
/// them from a PBF as they are.
inline void require_whole_tags(const osmium::TagList& tags) {
  const unsigned char *begin = tags.data() + sizeof(osmium::TagList),
                      *end = tags.data() + tags.byte_size();
  if (begin < end && (end[-1] != 0 || std::count(begin, end, 0) % 2 != 0))
    throw std::runtime_error("a tag holds a zero byte");
}

/// Throws where libosmium has no area of its own for a way or a relation of this id: it doubles
/// ids, and those of areas wrap round then. OpenStreetMap counts below 2^40, editors down from -1.
inline void require_sound_id(std::int64_t id) {
  constexpr std::int64_t limit = std::int64_t{1} << 62;
  if (id <= -limit || id >= limit) throw std::runtime_error("no id: " + std::to_string(id));
}

/// Comes before all that looks at ids or tags.
struct ObjectCheck : osmium::handler::Handler {
  void osm_object(const osmium::OSMObject& object) {
    require_sound_id(object.id());
    require_whole_tags(object.tags());
  }
};

}  // namespace nightcity::osm
