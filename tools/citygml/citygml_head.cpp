#include "tools/citygml/citygml_head.h"

#include <algorithm>
#include <array>
#include <pugixml.hpp>
#include <utility>

#include "formats/error.h"
#include "tools/city/attributes.h"
#include "tools/city/byte_source.h"
#include "tools/city/text_encoding.h"
#include "tools/citygml/curves.h"
#include "tools/citygml/read_citygml.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/srs_scope.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {
namespace {

constexpr std::size_t enough_points = 4096;

// Coordinates of the document's beginning, apart by the CRS that holds for them.
struct Sampler : pugi::xml_tree_walker {
  struct Sample {
    std::string srs_name;
    std::vector<glm::dvec3> rings;
    std::vector<glm::dvec3> points;  // of geometry without rings, in case there are no others
  };
  city::CityHead& head;
  std::vector<Sample> samples;
  std::string member_name;  // that the member's other geometry gives itself
  std::string document;     // the name of the document's own extent
  std::string first_name;   // of any element
  std::size_t vertices = 0;
  explicit Sampler(city::CityHead& h) : head(h) {}

  bool is_full() const {
    constexpr std::size_t too_many = 16;  // a file of points is not read to its end
    const Sample* chosen = choose();
    return (chosen && chosen->rings.size() >= enough_points) ||
           vertices >= too_many * enough_points;
  }

  // The first with rings, else the first with points.
  const Sample* choose() const {
    for (const Sample& sample : samples)
      if (!sample.rings.empty()) return &sample;
    return samples.empty() ? nullptr : &samples.front();
  }

  void finish() {
    const Sample* chosen = choose();
    head.srs_name = city::to_valid_utf8(chosen ? chosen->srs_name : first_name);
    if (chosen) head.sample = chosen->rings.empty() ? chosen->points : chosen->rings;
  }

  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element) return true;
    const std::string_view name = local_name(node.name());
    if (first_name.empty()) first_name = own_srs_name(node);
    take_link(node);
    if (name == "LinearRing" || is_curve_ring(name)) {
      city::Ring ring;
      if (is_relative(node) || read_ring(node, 0, ring) != RingFault::none || ring.empty())
        return true;
      Sample& sample = sample_of(node);
      sample.rings.insert(sample.rings.end(), ring.begin(), ring.end());
      sample.rings.push_back(ring.front());  // closes it
      vertices += ring.size();
    } else if ((name == "posList" || name == "pos") &&
               local_name(node.parent().name()) != "Envelope" && !is_in_ring(node)) {
      city::Ring points;
      if (read_vertices(node.parent(), find_dimension(node.parent().parent(), 0), points) !=
          RingFault::none)
        return true;
      Sample& sample = sample_of(node);
      sample.points.insert(sample.points.end(), points.begin(), points.end());
      vertices += points.size();
    }
    return !is_full();
  }

  // The shape of an implicit geometry has coordinates of its own.
  static bool is_relative(const pugi::xml_node& geometry) {
    for (pugi::xml_node at = geometry.parent(); at; at = at.parent())
      if (const auto name = local_name(at.name());
          name == "relativeGMLGeometry" || name == "relativeGeometry")
        return true;
    return false;
  }

  static bool is_in_ring(const pugi::xml_node& node) {
    for (pugi::xml_node at = node.parent(); at; at = at.parent())
      if (const auto name = local_name(at.name()); name == "LinearRing" || is_curve_ring(name))
        return true;
    return is_relative(node);
  }

  Sample& sample_of(const pugi::xml_node& geometry) {
    std::string_view name = find_srs_name(geometry);
    if (name.empty()) name = member_name;
    if (name.empty()) name = document;
    for (Sample& sample : samples)
      if (sample.srs_name == name) return sample;
    return samples.emplace_back(Sample{std::string(name), {}, {}});
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

// Returns the text with XML's five entities as what they stand for: WKT has quotes, URLs of
// compound systems have ampersands.
std::string decode_entities(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, char>, 5> entities{
      {{"&quot;", '"'}, {"&apos;", '\''}, {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}}};
  std::string out;
  while (!text.empty()) {
    const auto entity = std::find_if(entities.begin(), entities.end(),
                                     [&](const auto& e) { return text.starts_with(e.first); });
    out += entity == entities.end() ? text.front() : entity->second;
    text.remove_prefix(entity == entities.end() ? 1 : entity->first.size());
  }
  return out;
}

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

std::vector<std::string> list_srs_names(std::string_view text) {
  constexpr std::string_view key = "srsName=";
  std::vector<std::string> names;
  for (auto at = text.find(key); at != std::string_view::npos; at = text.find(key, at)) {
    at += key.size();
    if (at >= text.size()) break;
    const char quote = text[at++];
    const auto end = text.find(quote, at);
    if (end == std::string_view::npos) break;
    if (std::string name = decode_entities(city::trim(text.substr(at, end - at))); !name.empty())
      names.push_back(std::move(name));
    at = end;
  }
  return names;
}

std::string first_srs_name(const MemberBatch& batch) {
  for (const MemberBatch::Member& member : batch.members)
    if (const auto names = list_srs_names(batch.text(member)); !names.empty()) return names.front();
  return {};
}

std::string document_srs_name(const MemberBatch& batch) {
  for (const MemberBatch::Member& member : batch.members) {
    if (member.name != "boundedBy") continue;
    const auto names = list_srs_names(batch.text(member));
    return names.empty() ? std::string() : names.front();
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
  return read_documents_head(list_citygml_documents(file, nullptr), options);
}

city::CityHead read_documents_head(std::span<const city::Document> documents,
                                   const city::ReadOptions& options) {
  city::CityHead out;
  Sampler sampler(out);
  for (const city::Document& document : documents) {
    if (sampler.is_full()) break;
    const auto source = document.open();
    MemberSplitter splitter(*source, document.name, limits_of(options));
    require_citygml(splitter.head(), document.name);
    if (out.version.empty()) out.version = splitter.head().version;
    MemberBatch batch;
    while (!sampler.is_full() && splitter.next(batch)) {
      if (batch.first_member == 0) sampler.document = document_srs_name(batch);
      for (const MemberBatch::Member& member : batch.members) {
        pugi::xml_document xml;
        if (!xml.load_buffer_inplace(batch.bytes.get() + member.begin, member.size,
                                     gml_parse_flags))
          continue;
        sampler.member_name = first_own_srs_name(xml);
        xml.traverse(sampler);
        if (sampler.is_full()) break;
      }
    }
  }
  sampler.finish();
  return out;
}

}  // namespace nightcity::citygml
