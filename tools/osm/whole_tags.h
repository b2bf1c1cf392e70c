// A check of what libosmium hands over, for the few files that include it.
#pragma once

#include <osmium/osm/tag.hpp>

#include <algorithm>
#include <stdexcept>

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

}  // namespace nightcity::osm
