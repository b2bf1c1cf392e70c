#include "tools/citygml/compare_readers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <set>

#include "tools/citygml/read_citygml.h"

namespace nightcity {
namespace {

// Half the sum of cross products, from the ring's first vertex: nothing is lost far from the origin.
glm::dvec3 area_vector(const Ring& ring) {
  glm::dvec3 sum{0};
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return 0.5 * sum;
}

double area_of(const Polygon& polygon) {
  double area = glm::length(area_vector(polygon.exterior));
  for (const Ring& hole : polygon.interiors) area -= glm::length(area_vector(hole));
  return area;
}

using Tallies = std::map<std::string, std::pair<ReaderTally, ReaderTally>>;

bool all_alike(const Tallies& tallies) {
  return std::all_of(tallies.begin(), tallies.end(), [](const auto& entry) {
    return alike(entry.second.first, entry.second.second);
  });
}

ReadReport tally(const std::filesystem::path& file, Reader reader, int highest_lod,
                 ReaderComparison& out, std::set<std::string>& ids) {
  ReadOptions options;
  options.reader = reader;
  options.highest_lod = highest_lod;
  const auto side = [&](std::pair<ReaderTally, ReaderTally>& both) -> ReaderTally& {
    return reader == Reader::stream ? both.first : both.second;
  };
  std::string last_id;
  return read_citygml(file, options, [&](CityObject&& object) {
    ReaderTally& of_object = side(out.objects[name_of(object.type)]);
    // A large object comes in pieces under one id.
    if (object.id.empty() || object.id != last_id) ++of_object.objects;
    last_id = object.id;
    ids.insert(object.id);
    for (const Polygon& polygon : object.polygons) {
      const double area = area_of(polygon);
      ReaderTally& of_surface = side(out.surfaces[name_of(polygon.surface)]);
      for (ReaderTally* t : {&of_object, &of_surface}) {
        ++t->polygons;
        t->area += area;
      }
    }
  });
}

}  // namespace

bool alike(const ReaderTally& a, const ReaderTally& b) {
  constexpr double rounding = 1e-9;
  return a.objects == b.objects && a.polygons == b.polygons &&
         std::abs(a.area - b.area) <= rounding * std::abs(a.area);
}

bool ReaderComparison::agree() const {
  return all_alike(objects) && all_alike(surfaces) && only_in_stream.empty() &&
         only_in_libcitygml.empty();
}

ReaderComparison compare_readers(const std::filesystem::path& file, int highest_lod) {
  ReaderComparison out;
  std::set<std::string> stream_ids, libcitygml_ids;
  out.stream = tally(file, Reader::stream, highest_lod, out, stream_ids);
  out.libcitygml = tally(file, Reader::libcitygml, highest_lod, out, libcitygml_ids);
  std::set_difference(stream_ids.begin(), stream_ids.end(), libcitygml_ids.begin(),
                      libcitygml_ids.end(), std::back_inserter(out.only_in_stream));
  std::set_difference(libcitygml_ids.begin(), libcitygml_ids.end(), stream_ids.begin(),
                      stream_ids.end(), std::back_inserter(out.only_in_libcitygml));
  return out;
}

}  // namespace nightcity
