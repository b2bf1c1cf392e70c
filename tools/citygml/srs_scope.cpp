#include "tools/citygml/srs_scope.h"

#include "tools/city/attributes.h"
#include "tools/city/text_encoding.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {

std::string_view own_srs_name(const pugi::xml_node& element) {
  return city::trim(element.attribute("srsName").value());
}

std::string_view extent_srs_name(const pugi::xml_node& feature) {
  constexpr int first_children = 16;  // the extent follows names and metadata alone
  int number = 0;
  for (const pugi::xml_node& property : feature.children()) {
    if (property.type() != pugi::node_element) continue;
    if (++number > first_children) break;
    if (local_name(property.name()) != "boundedBy") continue;
    const pugi::xml_node extent = property.first_child();
    if (local_name(extent.name()) == "Envelope") return own_srs_name(extent);
  }
  return {};
}

std::string_view find_srs_name(const pugi::xml_node& geometry) {
  for (pugi::xml_node at = geometry; at.type() == pugi::node_element; at = at.parent()) {
    if (const std::string_view said = own_srs_name(at); !said.empty()) return said;
    if (const std::string_view said = extent_srs_name(at); !said.empty()) return said;
  }
  return {};
}

std::string_view first_own_srs_name(const pugi::xml_node& member) {
  struct Finder : pugi::xml_tree_walker {
    std::string_view name;
    bool for_each(pugi::xml_node& node) override {
      if (node.type() == pugi::node_element && local_name(node.name()) != "Envelope")
        name = own_srs_name(node);
      return name.empty();
    }
  } finder;
  pugi::xml_node(member).traverse(finder);
  return finder.name;
}

void SrsScope::enter(const pugi::xml_node& member) {
  if (known_) rest_ = to_name(first_own_srs_name(member), document_);
}

SrsScope::SrsScope(const std::optional<std::string>& known, const std::string& document)
    : known_(known) {
  document_ = to_name(document, {});
  rest_ = document_;
}

SrsName SrsScope::to_name(std::string_view srs_name, const SrsName& inherited) {
  if (!known_ || srs_name.empty()) return inherited;
  if (srs_name == *known_) return nullptr;
  for (const SrsName& name : names_)
    if (*name == srs_name) return name;
  std::string valid = city::to_valid_utf8(std::string(srs_name));
  if (valid == *known_) return nullptr;
  return names_.emplace_back(std::make_shared<const std::string>(std::move(valid)));
}

}  // namespace nightcity::citygml
