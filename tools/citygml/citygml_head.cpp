#include "tools/citygml/citygml_head.h"

#include <pugixml.hpp>

#include "formats/error.h"
#include "tools/city/byte_source.h"
#include "tools/citygml/read_citygml.h"
#include "tools/citygml/rings.h"

namespace nightcity {
namespace {

constexpr std::size_t enough_points = 4096;

struct Sampler : pugi::xml_tree_walker {
  CityHead& head;
  explicit Sampler(CityHead& h) : head(h) {}

  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element) return true;
    if (head.srs_name.empty()) head.srs_name = node.attribute("srsName").value();
    if (local_name(node.name()) != "LinearRing") return true;
    Ring ring;
    if (read_ring(node, 0, ring) != RingFault::none || ring.empty()) return true;
    head.sample.insert(head.sample.end(), ring.begin(), ring.end());
    head.sample.push_back(ring.front());  // closes it
    return head.sample.size() < enough_points;
  }
};

bool holds_city_objects(std::string_view root) {
  return root == "CityModel" || root == "FeatureCollection";
}

// Where the first start tag begins, behind the declaration and comments; npos where there is none.
std::size_t find_root(std::string_view start) {
  std::size_t at = start.find('<');
  while (at != std::string_view::npos && at + 1 < start.size()) {
    if (start[at + 1] != '?' && start[at + 1] != '!') return at;
    const std::string_view end = start.substr(at).starts_with("<!--") ? "-->" : ">";
    at = start.find(end, at);
    if (at != std::string_view::npos) at = start.find('<', at);
  }
  return std::string_view::npos;
}

}  // namespace

bool begins_as_citygml(std::string_view start) {
  std::size_t begin = find_root(start);
  if (begin == std::string_view::npos) return false;
  std::size_t end = ++begin;
  while (end < start.size() && !ends_name(start[end])) ++end;
  return holds_city_objects(local_name(start.substr(begin, end - begin)));
}

void require_citygml(const DocumentHead& head, const std::string& name) {
  if (!holds_city_objects(local_name(head.root_name)))
    throw Error(name, "is not CityGML: its root element is <" + head.root_name + ">");
}

std::string first_srs_name(const MemberBatch& batch) {
  constexpr std::string_view key = "srsName=";
  for (const MemberBatch::Member& member : batch.members) {
    const std::string_view text = batch.text(member);
    const auto at = text.find(key);
    if (at == std::string_view::npos || at + key.size() >= text.size()) continue;
    const auto begin = at + key.size() + 1;
    const auto end = text.find(text[begin - 1], begin);
    if (end != std::string_view::npos) return std::string(text.substr(begin, end - begin));
  }
  return {};
}

CityHead read_citygml_head(const std::filesystem::path& file) {
  CityHead out;
  for (const city::Document& document : city::list_documents(file, citygml_endings)) {
    if (out.sample.size() >= enough_points) break;
    const auto source = document.open();
    MemberSplitter splitter(*source, document.name, {});
    require_citygml(splitter.head(), document.name);
    if (out.version.empty()) out.version = splitter.head().version;
    MemberBatch batch;
    while (out.sample.size() < enough_points && splitter.next(batch)) {
      for (const MemberBatch::Member& member : batch.members) {
        pugi::xml_document document;
        if (!document.load_buffer_inplace(batch.bytes.get() + member.begin, member.size,
                                          gml_parse_flags))
          continue;
        Sampler sampler(out);
        document.traverse(sampler);
        if (out.sample.size() >= enough_points) break;
      }
    }
  }
  return out;
}

}  // namespace nightcity
