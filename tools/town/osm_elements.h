// The elements of an OSM XML document, and the town's places as longitude and latitude.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>

#include "tools/town/text_file.h"
#include "tools/town/town.h"

namespace nightcity::town {

class OsmElements {
 public:
  /// Both must outlive the object.
  OsmElements(TextFile& out, const TownOptions& options) : out_(out), options_(options) {}

  /// Begins a node at a place of the town, metres east and north of its origin; "/>" or ">" is to
  /// follow.
  OsmElements& open_node(std::int64_t id, const glm::dvec2& p);
  void tag(std::string_view key, std::string_view value);
  template <class Value>
  OsmElements& operator<<(const Value& value) {
    out_ << value;
    return *this;
  }

 private:
  TextFile& out_;
  const TownOptions& options_;
};

}  // namespace nightcity::town
