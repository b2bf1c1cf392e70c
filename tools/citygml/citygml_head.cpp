#include "tools/citygml/citygml_head.h"

#include <pugixml.hpp>

#include "formats/error.h"
#include "tools/city/attributes.h"
#include "tools/city/byte_source.h"
#include "tools/city/text_encoding.h"
#include "tools/citygml/curves.h"
#include "tools/citygml/read_citygml.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {
namespace {

constexpr std::size_t enough_points = 4096;

struct Sampler : pugi::xml_tree_walker {
  city::CityHead& head;
  std::vector<glm::dvec3> points;  // of geometry without rings, in case there are no others
  bool own_name = false;           // head.srs_name is a geometry's own
  explicit Sampler(city::CityHead& h) : head(h) {}

  bool is_full() const {
    constexpr std::size_t without_rings = 16;  // a file of points is not read to its end
    return head.sample.size() >= enough_points || points.size() >= without_rings * enough_points;
  }

  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element) return true;
    const std::string_view name = local_name(node.name());
    take_srs_name(node, name);
    take_link(node);
    if (name == "LinearRing" || is_curve_ring(name)) {
      city::Ring ring;
      if (read_ring(node, 0, ring) != RingFault::none || ring.empty()) return true;
      head.sample.insert(head.sample.end(), ring.begin(), ring.end());
      head.sample.push_back(ring.front());  // closes it
    } else if ((name == "posList" || name == "pos") && head.sample.empty() &&
               local_name(node.parent().name()) != "Envelope") {
      city::Ring vertices;
      if (read_vertices(node.parent(), find_dimension(node.parent().parent(), 0), vertices) ==
          RingFault::none)
        points.insert(points.end(), vertices.begin(), vertices.end());
    }
    return !is_full();
  }

  void take_srs_name(const pugi::xml_node& node, std::string_view name) {
    if (own_name) return;
    const std::string_view said = city::trim(node.attribute("srsName").value());
    if (said.empty()) return;
    own_name = name != "Envelope";
    if (own_name || head.srs_name.empty()) head.srs_name = city::to_valid_utf8(std::string(said));
  }

  void take_link(const pugi::xml_node& node) {
    constexpr std::size_t max_files = 20;
    if (node.first_child() || head.linked_files.size() >= max_files) return;
    const std::string_view href = city::trim(find_attribute(node, "href"));
    const std::size_t hash = href.find('#');
    if (hash == 0 || hash == std::string_view::npos) return;
    head.linked_files.insert(city::to_valid_utf8(std::string(href.substr(0, hash))));
  }
};

bool holds_city_objects(std::string_view root) {
  return root == "CityModel" || root == "FeatureCollection";
}

// Returns the beginning of the first start tag, behind the declaration and
// comments; npos if there is none.
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
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || start[first] != '<') return false;
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

std::vector<city::Document> list_citygml_documents(const std::filesystem::path& file,
                                                   std::vector<std::string>* warnings) {
  std::vector<city::Document> all = city::list_documents(file, citygml_endings);
  if (all.size() == 1) return all;
  std::vector<city::Document> documents;
  std::string first_root;
  for (city::Document& document : all) {
    const auto source = document.open();
    const MemberSplitter splitter(*source, document.name, {});
    const std::string root = splitter.head().root_name;
    if (holds_city_objects(local_name(root))) {
      documents.push_back(std::move(document));
      continue;
    }
    if (first_root.empty()) first_root = root;
    if (warnings)
      warnings->push_back(document.name + ": passed over, it is no CityGML but <" + root + ">");
  }
  if (documents.empty())
    throw Error(file.string(),
                "the archive holds no CityGML: its first document is <" + first_root + ">");
  return documents;
}

city::CityHead read_citygml_head(const std::filesystem::path& file,
                                 const city::ReadOptions& options) {
  city::CityHead out;
  Sampler sampler(out);
  for (const city::Document& document : list_citygml_documents(file, nullptr)) {
    if (sampler.is_full()) break;
    const auto source = document.open();
    MemberSplitter splitter(*source, document.name, limits_of(options));
    require_citygml(splitter.head(), document.name);
    if (out.version.empty()) out.version = splitter.head().version;
    MemberBatch batch;
    while (!sampler.is_full() && splitter.next(batch)) {
      for (const MemberBatch::Member& member : batch.members) {
        pugi::xml_document xml;
        if (!xml.load_buffer_inplace(batch.bytes.get() + member.begin, member.size,
                                     gml_parse_flags))
          continue;
        xml.traverse(sampler);
        if (sampler.is_full()) break;
      }
    }
  }
  if (out.sample.empty()) out.sample = std::move(sampler.points);
  return out;
}

}  // namespace nightcity::citygml
