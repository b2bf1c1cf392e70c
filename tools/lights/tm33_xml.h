// Elements of TM-33 by their names without the prefix of a namespace.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "tools/city/attributes.h"

namespace nightcity::lights {

inline std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') == name.npos ? 0 : name.find(':') + 1);
}

inline pugi::xml_node find_child(const pugi::xml_node& parent, std::string_view name) {
  return parent.find_child([&](const pugi::xml_node& node) { return local_name(node) == name; });
}

inline std::string text_of(const pugi::xml_node& parent, std::string_view name) {
  return std::string(city::trim(find_child(parent, name).text().get()));
}

}  // namespace nightcity::lights
