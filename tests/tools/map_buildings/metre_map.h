// Maps of known content in metres, and what is read of them.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/tools/citygml/temporary_file.h"
#include "tools/city/ring.h"
#include "tools/map_buildings/read_map_buildings.h"

namespace nightcity::test {

// At the equator, of longitude and of latitude, on the ellipsoid of WGS 84.
constexpr double lon_m = 111'319.49, lat_m = 110'574.28;
// Maps hold 1e-7 degrees, a centimetre.
constexpr double rounding = 0.005;  // relative

// Places in metres near longitude 10 on the equator.
class Map {
 public:
  // Returns the id of a closed way round a rectangle.
  int add_rectangle(double x, double y, double width, double height, const std::string& tags) {
    const int first = next_;
    const double corners[4][2] = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    for (const auto& corner : corners)
      nodes_ += "<node id=\"" + std::to_string(next_++) + "\" version=\"1\" lat=\"" +
                write(corner[1] / lat_m) + "\" lon=\"" + write(10 + corner[0] / lon_m) + "\"/>\n";
    const int way = next_++;
    ways_ += "<way id=\"" + std::to_string(way) + "\" version=\"1\">";
    for (const int k : {0, 1, 2, 3, 0}) ways_ += "<nd ref=\"" + std::to_string(first + k) + "\"/>";
    ways_ += tags_of(tags) + "</way>\n";
    return way;
  }
  void add_point(double x, double y, const std::string& tags) {
    nodes_ += "<node id=\"" + std::to_string(next_++) + "\" version=\"1\" lat=\"" +
              write(y / lat_m) + "\" lon=\"" + write(10 + x / lon_m) + "\">" + tags_of(tags) +
              "</node>\n";
  }
  void add_building_relation(int outline, int part, const std::string& tags) {
    relations_ += "<relation id=\"" + std::to_string(next_++) +
                  "\" version=\"1\"><member type=\"way\" ref=\"" + std::to_string(outline) +
                  "\" role=\"outline\"/><member type=\"way\" ref=\"" + std::to_string(part) +
                  "\" role=\"part\"/><tag k=\"type\" v=\"building\"/>" + tags_of(tags) +
                  "</relation>\n";
  }
  void add_multipolygon(int outer, int inner, const std::string& tags) {
    relations_ += "<relation id=\"" + std::to_string(next_++) +
                  "\" version=\"1\"><member type=\"way\" ref=\"" + std::to_string(outer) +
                  "\" role=\"outer\"/><member type=\"way\" ref=\"" + std::to_string(inner) +
                  "\" role=\"inner\"/><tag k=\"type\" v=\"multipolygon\"/>" + tags_of(tags) +
                  "</relation>\n";
  }
  std::string text() const {
    return "<?xml version=\"1.0\"?>\n<osm version=\"0.6\">\n" + nodes_ + ways_ + relations_ +
           "</osm>\n";
  }
  // Ways before the nodes that they name, as some programs write.
  std::string text_in_no_order() const {
    return "<?xml version=\"1.0\"?>\n<osm version=\"0.6\">\n" + relations_ + ways_ + nodes_ +
           "</osm>\n";
  }

 private:
  static std::string write(double degrees) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7f", degrees);
    return text;
  }
  // "building=yes,height=9"
  static std::string tags_of(const std::string& list) {
    std::string out;
    for (std::size_t begin = 0; begin < list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      const std::string one = list.substr(begin, end - begin);
      const std::size_t equals = one.find('=');
      out += "<tag k=\"" + one.substr(0, equals) + "\" v=\"" + one.substr(equals + 1) + "\"/>";
      begin = end + 1;
    }
    return out;
  }
  int next_ = 1;
  std::string nodes_, ways_, relations_;
};

struct Read {
  std::vector<city::CityObject> objects;
  city::ReadReport report;
};

inline Read read(const Map& map) {
  const TemporaryFile file(map.text(), ".osm");
  Read result;
  city::ObjectSink sink = [&](city::CityObject&& o) { result.objects.push_back(std::move(o)); };
  result.report = map_buildings::read_map_buildings(file.path(), {}, city::deliver_to(sink));
  return result;
}

inline double volume(const city::CityObject& object) {
  const auto to_metres = [](city::Ring ring) {
    for (glm::dvec3& p : ring) p = {(p.x - 10) * lon_m, p.y * lat_m, p.z};
    return ring;
  };
  double sum = 0;
  for (const city::Polygon& polygon : object.polygons) {
    const city::Ring ring = to_metres(polygon.exterior);
    glm::dvec3 vector = city::area_vector(ring);
    for (const city::Ring& hole : polygon.interiors) vector += city::area_vector(to_metres(hole));
    sum += glm::dot(vector, ring.front()) / 3;
  }
  return sum;
}

inline void expect_near(double value, double expected) {
  EXPECT_NEAR(value, expected, rounding * expected);
}

}  // namespace nightcity::test
