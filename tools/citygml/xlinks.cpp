#include "tools/citygml/xlinks.h"

#include "formats/percent_text.h"
#include "tools/city/attributes.h"

namespace nightcity::citygml {

std::string_view find_attribute(const pugi::xml_node& element, std::string_view local) {
  for (pugi::xml_attribute a = element.first_attribute(); a; a = a.next_attribute()) {
    const std::string_view name = a.name();
    if (name.ends_with(local) &&
        (name.size() == local.size() || name[name.size() - local.size() - 1] == ':'))
      return a.value();
  }
  return {};
}

pugi::xml_node IdIndex::find(std::string_view id) {
  if (!made_) {
    struct Collector : pugi::xml_tree_walker {
      std::unordered_map<std::string_view, pugi::xml_node>& nodes;
      explicit Collector(std::unordered_map<std::string_view, pugi::xml_node>& n) : nodes(n) {}
      bool for_each(pugi::xml_node& node) override {
        const std::string_view here = city::trim(find_attribute(node, "id"));
        if (!here.empty()) nodes.emplace(here, node);
        return true;
      }
    };
    Collector collector(nodes_);
    member_.traverse(collector);
    made_ = true;
  }
  const auto at = nodes_.find(id);
  return at == nodes_.end() ? pugi::xml_node() : at->second;
}

bool GeometryLibrary::is_in_document(std::string_view href) const {
  const std::size_t hash = href.find('#');
  if (hash == 0 || hash == std::string_view::npos) return hash == 0;
  const std::string file = decode_percent(city::trim(href.substr(0, hash)));
  return std::filesystem::path(file).lexically_normal() == file_name;
}

std::string GeometryLibrary::name_elsewhere(std::string_view href) const {
  const std::size_t hash = href.find('#');
  if (!neighbours || hash == 0 || hash == std::string_view::npos) return {};
  const std::string_view written = city::trim(href.substr(0, hash));
  std::filesystem::path file = (folder / written).lexically_normal();
  if (!neighbours->contains(file)) file = (folder / decode_percent(written)).lexically_normal();
  if (!neighbours->contains(file)) return {};
  return file.string() + "#" + std::string(city::trim(href.substr(hash + 1)));
}

std::pair<std::filesystem::path, std::string> GeometryLibrary::split_name(
    const std::string& name) const {
  const std::size_t hash = name.rfind('#');
  if (!neighbours || hash == std::string::npos || !neighbours->contains(name.substr(0, hash)))
    return {{}, name};
  return {name.substr(0, hash), name.substr(hash + 1)};
}

}  // namespace nightcity::citygml
