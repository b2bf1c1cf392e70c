// Where a geometry's xlink leads: within its member at once, anywhere else in the file through a library
// filled by a second pass.
#pragma once

#include <filesystem>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity {

/// Attribute by local name, whatever its prefix: gml:id, xlink:href.
std::string_view attribute_named(const pugi::xml_node& element, std::string_view local);

/// Geometry that members refer to and other members hold, as polygons; by id. That of another file of the
/// city is named by elsewhere().
struct GeometryLibrary {
  std::unordered_map<std::string, std::vector<Polygon>> polygons{};
  std::filesystem::path folder{};  // of the document, from which file names in links count
  std::shared_ptr<const std::set<std::filesystem::path>>
      neighbours{};  // files that links may lead into

  /// The name of what "../there.gml#id" leads to, "path#id"; "" where it leads out of the city.
  std::string elsewhere(std::string_view href) const;
  /// Takes such a name apart; the path is empty for the id of something in the same file.
  std::pair<std::filesystem::path, std::string> parts(const std::string& name) const;
};

/// Elements with an id in one member; made on first use, for most members need none.
class IdIndex {
 public:
  explicit IdIndex(const pugi::xml_node& member) : member_(member) {}
  /// Null when no element of the member has this id.
  pugi::xml_node find(std::string_view id);

 private:
  pugi::xml_node member_;
  bool made_ = false;
  std::unordered_map<std::string_view, pugi::xml_node> nodes_;
};

}  // namespace nightcity
