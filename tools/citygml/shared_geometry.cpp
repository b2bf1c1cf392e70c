#include "tools/citygml/shared_geometry.h"

#include <algorithm>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "tools/city/ring.h"
#include "tools/citygml/geometry_walk.h"
#include "tools/citygml/member_splitter.h"
#include "tools/citygml/rings.h"

namespace nightcity::citygml {
namespace {

constexpr int max_rounds = 4;  // for links to links to links across members

class Fetcher {
 public:
  Fetcher(SrsScope scope, std::uint64_t& next, std::size_t& room)
      : scope_(std::move(scope)), next_(next), room_(room) {}

  // Takes every wanted geometry that the member holds, and notes the ids that it refers to without
  // holding them.
  void fetch_from(const pugi::xml_node& member, const std::unordered_set<std::string>& wanted,
                  std::unordered_set<std::string>& missing) {
    IdIndex ids(member);
    scope_.enter(member);
    for (const std::string& id : wanted) {
      if (library_.polygons.contains(id) || without_room_.contains(id)) continue;
      const pugi::xml_node element = ids.find(id);
      if (!element) continue;
      library_.max_vertices = room_;
      city::SkipCounter counted_where_it_stands;
      GeometryWalk walk(member, library_, counted_where_it_stands);
      city::RawPolygons raws;
      walk.set_srs_scope(&scope_);
      GeometryContext context;
      context.srs_name = scope_.to_name(find_srs_name(element), scope_.name_of_rest());
      walk.read_element(element, context, raws);
      if (walk.unresolved().empty()) {
        take(id, walk, std::move(raws));
      } else {  // to be read again when those are known
        missing.insert(walk.unresolved().begin(), walk.unresolved().end());
        missing.insert(id);
      }
    }
  }

  FetchedGeometry finish() && { return {std::move(library_.polygons), without_room_.size()}; }

 private:
  void take(const std::string& id, const GeometryWalk& walk, city::RawPolygons&& raws) {
    std::size_t vertices = 0;
    for (const city::Polygon& raw : raws.polygons()) vertices += city::count_vertices(raw);
    if (walk.took_too_many() || vertices > room_) {
      without_room_.insert(id);
      return;
    }
    room_ -= vertices;
    std::vector<LinkedPolygon>& polygons = library_.polygons[id];
    for (std::size_t i = 0; i < raws.size(); ++i) {
      const std::uint64_t known = i < walk.linked_numbers().size() ? walk.linked_numbers()[i] : 0;
      polygons.push_back({std::move(raws[i]), known > 0 ? known : next_++});
    }
  }

  SrsScope scope_;
  std::uint64_t& next_;
  std::size_t& room_;
  GeometryLibrary library_;
  std::unordered_set<std::string> without_room_;
};

}  // namespace

FetchedGeometry fetch_geometry(const city::Document& document,
                               std::unordered_set<std::string> wanted,
                               const city::ReadOptions& options,
                               const std::string& document_srs_name, std::uint64_t& next,
                               std::size_t& room) {
  Fetcher fetcher(SrsScope(options.srs_name, document_srs_name), next, room);
  for (int round = 0; round < max_rounds && !wanted.empty(); ++round) {
    std::unordered_set<std::string> missing;
    const auto source = document.open();
    MemberSplitter splitter(*source, document.name, limits_of(options));
    MemberBatch batch;
    while (splitter.next(batch)) {
      for (const MemberBatch::Member& member : batch.members) {
        pugi::xml_document xml;
        if (xml.load_buffer_inplace(batch.bytes.get() + member.begin, member.size, gml_parse_flags))
          fetcher.fetch_from(xml, wanted, missing);
      }
    }
    wanted = std::move(missing);
  }
  return std::move(fetcher).finish();
}

}  // namespace nightcity::citygml
