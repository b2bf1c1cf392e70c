// libFuzzer target: reads any bytes as a map, for its areas: closed ways and multipolygons. Land
// covers the ground, buildings stand, and both are triangulated.
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/finite.h"
#include "support/fuzz_file.h"
#include "tests/tools/city/fuzz_city.h"
#include "tests/tools/osm/mutate_map.h"
#include "tools/ground_cover/land_areas.h"
#include "tools/map_buildings/read_map_buildings.h"
#include "tools/mesh/partition.h"
#include "tools/osm/map_areas.h"

namespace {

using namespace nightcity;

constexpr std::size_t max_nodes = 500;  // the time to assemble rings grows with their square

void check_ring(const std::vector<glm::dvec2>& ring) {
  for (const glm::dvec2& p : ring)
    if (!(std::abs(p.x) <= 180 && std::abs(p.y) <= 90)) std::abort();
}

void check_areas(const osm::MapAreas& areas) {
  for (const osm::MapArea& area : areas.areas) {
    if (area.tags.empty() || area.rings.empty()) std::abort();
    for (const osm::MapRings& rings : area.rings) {
      if (rings.outer.size() < 3) std::abort();
      check_ring(rings.outer);
      for (const auto& hole : rings.holes) check_ring(hole);
    }
  }
}

// A degree is 100 m here, and a square kilometre in the middle of the first area is covered.
void cover_ground(const osm::MapAreas& areas) {
  if (areas.areas.empty()) return;
  const glm::dvec2 middle = areas.areas.front().rings.front().outer.front();
  const auto to_frame = [&](const glm::dvec2& p) { return 100.0 * (p - middle); };
  const ground_cover::Box box{{-500, -500}, {500, 500}};
  ground_cover::Cover cover;
  ground_cover::add_land(areas.areas, to_frame, box, cover);
  cover.finish();
  const std::vector<mesh::PlaneLayer> layers{cover.find_part(box, {0, 0}).areas};
  const mesh::PlanePartition plan = mesh::partition(layers);
  double sum = 0;
  for (const auto& t : plan.triangles) {
    const glm::dvec2 a = plan.points[t.vertex[0]], b = plan.points[t.vertex[1]] - a,
                     c = plan.points[t.vertex[2]] - a;
    sum += (b.x * c.y - b.y * c.x) / 2;
  }
  if (!(sum >= 0 && sum <= 1e6 * (1 + 1e-9))) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const test::FuzzFile file(data, size);
  try {
    const osm::MapAreas land =
        osm::read_map_areas(file.path(), ground_cover::select_land(), max_nodes);
    check_areas(land);
    cover_ground(land);
  } catch (const Error&) {  // a broken file, or outlines that cross too often
  }
  test::fuzz_city(data, size, [&](const auto&, city::ReadOptions options, const auto& stage) {
    options.max_way_nodes = max_nodes;
    map_buildings::read_map_buildings(file.path(), options, stage);
  });
  return 0;
}
