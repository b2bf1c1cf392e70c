// X3DMaterial colours of an app:Appearance, by the id of what they colour.
#pragma once

#include <glm/vec3.hpp>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_map>

#include "tools/citygml/skip_counter.h"

namespace nightcity {

class Materials {
 public:
  /// Reads app:Appearance (or a property that holds one). Textures and what else it holds are counted in
  /// `skipped`.
  void read(const pugi::xml_node& appearance, SkipCounter& skipped);
  /// sRGB as in the file; null when the id has none. The first material of an id wins.
  const glm::vec3* find(std::string_view id) const;
  bool empty() const { return colours_.empty(); }

 private:
  void read_below(const pugi::xml_node& element, int depth, SkipCounter& skipped);

  std::unordered_map<std::size_t, glm::vec3>
      colours_;  // by the id's hash: a city's ids would fill memory
};

}  // namespace nightcity
