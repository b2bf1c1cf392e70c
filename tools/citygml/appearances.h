// X3DMaterial colours of an app:Appearance, by the id of what they colour.
#pragma once

#include <glm/vec3.hpp>
#include <pugixml.hpp>
#include <string>
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
  void merge(const Materials& other) { colours_.insert(other.colours_.begin(), other.colours_.end()); }

 private:
  void read_below(const pugi::xml_node& element, int depth, SkipCounter& skipped);

  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view s) const { return std::hash<std::string_view>()(s); }
  };
  std::unordered_map<std::string, glm::vec3, Hash, std::equal_to<>> colours_;
};

}  // namespace nightcity
