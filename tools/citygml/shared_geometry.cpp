#include "tools/citygml/shared_geometry.h"

#include <algorithm>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "tools/citygml/geometry_walk.h"
#include "tools/citygml/member_splitter.h"
#include "tools/citygml/rings.h"

namespace nightcity::citygml {
namespace {

constexpr int max_rounds = 4;  // for links to links to links across members

std::size_t vertices_of(const std::vector<city::Polygon>& polygons) {
  std::size_t count = 0;
  for (const city::Polygon& p : polygons) {
    count += p.exterior.size();
    for (const city::Ring& ring : p.interiors) count += ring.size();
  }
  return count;
}

// Takes every wanted geometry that the member holds, and the ids that it refers to without holding
// them.
void fetch_from(const pugi::xml_node& member, const std::unordered_set<std::string>& wanted,
                GeometryLibrary& library, std::size_t& room,
                std::unordered_set<std::string>& missing) {
  IdIndex ids(member);
  for (const std::string& id : wanted) {
    if (library.polygons.contains(id) || room == 0) continue;
    const pugi::xml_node element = ids.find(id);
    if (!element) continue;
    city::SkipCounter counted_where_it_stands;
    GeometryWalk walk(member, library, counted_where_it_stands);
    std::vector<city::RawPolygon> raws;
    walk.read_element(element, {}, raws);
    if (!walk.unresolved().empty()) {  // to be read again when those are known
      missing.insert(walk.unresolved().begin(), walk.unresolved().end());
      missing.insert(id);
      continue;
    }
    std::vector<city::Polygon>& polygons = library.polygons[id];
    for (city::RawPolygon& raw : raws) polygons.push_back(std::move(raw.polygon));
    room -= std::min(room, vertices_of(polygons));
  }
}

}  // namespace

GeometryLibrary fetch_geometry(const city::Document& document,
                               std::unordered_set<std::string> wanted, std::size_t& room) {
  GeometryLibrary library;
  for (int round = 0; round < max_rounds && !wanted.empty(); ++round) {
    std::unordered_set<std::string> missing;
    const auto source = document.open();
    MemberSplitter splitter(*source, document.name, {});
    MemberBatch batch;
    while (splitter.next(batch)) {
      for (const MemberBatch::Member& member : batch.members) {
        pugi::xml_document xml;
        if (xml.load_buffer_inplace(batch.bytes.get() + member.begin, member.size, gml_parse_flags))
          fetch_from(xml, wanted, library, room, missing);
      }
    }
    wanted = std::move(missing);
  }
  return library;
}

}  // namespace nightcity::citygml
