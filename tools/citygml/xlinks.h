// Resolves the xlinks of geometry: within its member at once, elsewhere in the city through a
// library that a second pass over the files fills.
#pragma once

#include <cstdint>
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

namespace nightcity::citygml {

/// Returns the value of an attribute by its name without prefix (gml:id, xlink:href); "" where it
/// is absent.
std::string_view find_attribute(const pugi::xml_node& element, std::string_view local);

class PictureColours;

/// A polygon that links lead to. `number` is that of the polygon as it stands in its file: copies
/// by way of different links share it.
struct LinkedPolygon {
  city::Polygon polygon;
  std::uint64_t number;
};

/// Geometry that members refer to and other members hold, as polygons by id. Geometry of another
/// file of the city has the name that name_elsewhere() returns.
struct GeometryLibrary {
  std::unordered_map<std::string, std::vector<LinkedPolygon>> polygons{};
  std::size_t max_vertices = 0;    // that one member may take from here
  std::filesystem::path folder{};  // of the document: file names in links are relative to it
  std::string file_name{};         // of the document, in its folder
  /// Files that links may lead into.
  std::shared_ptr<const std::set<std::filesystem::path>> neighbours{};
  PictureColours* pictures = nullptr;  // of the document; null: textures are not read

  /// Returns whether a link leads into its own document: "#id", or "here.gml#id" in here.gml.
  bool is_in_document(std::string_view href) const;
  /// Returns the name of the target of "../there.gml#id", "path#id"; "" where it lies outside the
  /// city.
  std::string name_elsewhere(std::string_view href) const;
  /// Splits such a name into path and id; the path of a target in the same file is empty.
  std::pair<std::filesystem::path, std::string> split_name(const std::string& name) const;
};

/// The elements with an id in one member. Made on first use, because most members need none.
class IdIndex {
 public:
  explicit IdIndex(const pugi::xml_node& member) : member_(member) {}
  /// Returns null when no element of the member has this id.
  pugi::xml_node find(std::string_view id);

 private:
  pugi::xml_node member_;
  bool made_ = false;
  std::unordered_map<std::string_view, pugi::xml_node> nodes_;
};

}  // namespace nightcity::citygml
