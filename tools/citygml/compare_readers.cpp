#include "tools/citygml/compare_readers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <set>

#include "tools/city/ring.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

double find_area(const city::Polygon& polygon) {
  double area = glm::length(city::area_vector(polygon.exterior));
  for (const city::Ring& hole : polygon.interiors) area -= glm::length(city::area_vector(hole));
  return area;
}

using Tallies = std::map<std::string, std::pair<ReaderTally, ReaderTally>>;

bool all_alike(const Tallies& tallies) {
  return std::all_of(tallies.begin(), tallies.end(), [](const auto& entry) {
    return alike(entry.second.first, entry.second.second);
  });
}

city::ReadReport tally(const std::filesystem::path& file, city::Reader reader, int max_lod,
                       ReaderComparison& out, std::set<std::string>& ids) {
  city::ReadOptions options;
  options.reader = reader;
  options.max_lod = max_lod;
  const auto side = [&](std::pair<ReaderTally, ReaderTally>& both) -> ReaderTally& {
    return reader == city::Reader::stream ? both.first : both.second;
  };
  std::string last_id;
  return read_citygml(file, options, [&](city::CityObject&& object) {
    ReaderTally& of_object = side(out.objects[city::name_of(object.type)]);
    // A large object comes in pieces under one id.
    if (object.id.empty() || object.id != last_id) ++of_object.objects;
    last_id = object.id;
    ids.insert(object.id);
    for (const city::Polygon& polygon : object.polygons) {
      const double area = find_area(polygon);
      ReaderTally& of_surface = side(out.surfaces[city::name_of(polygon.surface)]);
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

ReaderComparison compare_readers(const std::filesystem::path& file, int max_lod) {
  ReaderComparison out;
  std::set<std::string> stream_ids, libcitygml_ids;
  out.stream = tally(file, city::Reader::stream, max_lod, out, stream_ids);
  out.libcitygml = tally(file, city::Reader::libcitygml, max_lod, out, libcitygml_ids);
  std::set_difference(stream_ids.begin(), stream_ids.end(), libcitygml_ids.begin(),
                      libcitygml_ids.end(), std::back_inserter(out.only_in_stream));
  std::set_difference(libcitygml_ids.begin(), libcitygml_ids.end(), stream_ids.begin(),
                      stream_ids.end(), std::back_inserter(out.only_in_libcitygml));
  return out;
}

}  // namespace nightcity::citygml
