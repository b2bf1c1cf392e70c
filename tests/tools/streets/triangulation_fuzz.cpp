// libFuzzer target: any bytes as outlines in the plane, through every constrained triangulation: of
// a polygon (and the area that comes out), of road surfaces with their chordal axis, and of a
// ground with break lines.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "formats/error.h"
#include "tools/mesh/constrained.h"
#include "tools/streets/chordal_axis.h"
#include "tools/streets/road_outline.h"
#include "tools/terrain/made_surface.h"

namespace nightcity::streets {
namespace {

constexpr std::size_t max_points = 60;  // crossings grow with their square

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  std::size_t left() const { return left_; }
  std::uint8_t next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  // One byte on a grid, where much coincides, or a double near it.
  double coordinate(bool on_grid) {
    const double value = next() % 32;
    return on_grid ? value : value + 1e-3 * std::pow(2.0, -(next() % 64));
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

double area(const mesh::FlatTriangulation& flat, const std::array<std::uint32_t, 3>& t) {
  const glm::dvec2 a = flat.points[t[0]], b = flat.points[t[1]] - a, c = flat.points[t[2]] - a;
  return (b.x * c.y - b.y * c.x) / 2;
}

void run(Bytes bytes) {
  const std::uint8_t kind = bytes.next();
  const bool on_grid = kind & 1;
  std::vector<glm::dvec2> points;
  std::vector<std::vector<std::uint32_t>> outlines(1);
  while (bytes.left() > 0 && points.size() < max_points) {
    const double x = bytes.coordinate(on_grid), y = bytes.coordinate(on_grid);
    outlines.back().push_back(static_cast<std::uint32_t>(points.size()));
    points.emplace_back(x, y);
    if (bytes.next() % 8 == 0) outlines.emplace_back();
  }
  try {
    const mesh::FlatTriangulation flat = mesh::triangulate_flat(points, outlines);
    for (const auto& t : flat.triangles)
      // Exact crossings are rounded to doubles at the end.
      if (!(area(flat, t) > -1e-9)) std::abort();
  } catch (const Error&) {
  }
  std::vector<streets::RoadSurface> roads;
  std::vector<std::vector<glm::dvec3>> lines;
  for (const auto& outline : outlines) {
    if (outline.size() < 3) continue;
    streets::RoadSurface& road = roads.emplace_back();
    std::vector<glm::dvec3>& line = lines.emplace_back();
    for (const std::uint32_t i : outline) {
      road.exterior.push_back(points[i]);
      line.emplace_back(points[i], points[i].x);
    }
  }
  if (kind & 2) streets::chordal_axis(streets::road_outline(roads, 1000), 2.5);
  if (kind & 4) terrain::make_surface({{0, 0, 0}, {31, 31, 1}}, lines, 10);
}

}  // namespace
}  // namespace nightcity::streets

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nightcity::streets::run({data, size});
  return 0;
}
