// A cheap look at a document's beginning: version, srsName, some coordinates.
#include <pugixml.hpp>

#include <cstring>

#include "formats/error.h"
#include "tools/citygml/document_reader.h"
#include "tools/citygml/rings.h"

namespace nightcity {
namespace {

constexpr std::size_t enough_points = 4096;

struct Sampler : pugi::xml_tree_walker {
  CityGmlHead& head;
  explicit Sampler(CityGmlHead& h) : head(h) {}

  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element) return true;
    if (head.srs_name.empty()) head.srs_name = node.attribute("srsName").value();
    if (local_name(node.name()) != "LinearRing") return true;
    Ring ring;
    if (read_ring(node, 0, ring) != RingFault::none || ring.empty()) return true;
    head.sample.insert(head.sample.end(), ring.begin(), ring.end());
    head.sample.push_back(
        ring.front());  // closed again: whoever tells handedness needs to see where rings end
    return head.sample.size() < enough_points;
  }
};

}  // namespace

CityGmlHead read_citygml_head(const std::filesystem::path& file) {
  CityGmlHead out;
  for (const Document& document : documents_in(file)) {
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
