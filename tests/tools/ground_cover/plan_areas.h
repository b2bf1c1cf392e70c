// The areas of a cover in plan.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/tools/ground_cover/metre_map.h"
#include "tools/ground_cover/cover.h"
#include "tools/mesh/partition.h"

namespace nightcity::ground_cover {

/// Returns the area of each material within a rectangle, m2; that of "paint" on carriageways and
/// "sunken" surfaces are parts of these, "rail" lies on all.
inline std::map<std::string, double> areas_of(const Cover& cover, const Box& box) {
  const CoverPart part = cover.find_part(box, {0, 0});
  const std::vector<mesh::PlaneLayer> layers{part.areas, part.markings};
  const mesh::PlanePartition plan = mesh::partition(layers);
  std::map<std::string, double> areas;
  for (const auto& t : plan.triangles) {
    const glm::dvec2 a = plan.points[t.vertex[0]], b = plan.points[t.vertex[1]] - a,
                     c = plan.points[t.vertex[2]] - a;
    const double area = (b.x * c.y - b.y * c.x) / 2;
    const auto& owners = plan.owners[t.region];
    if (owners[1] == static_cast<std::uint32_t>(Marking::rail)) {
      areas["rail"] += area;
      continue;
    }
    if (owners[0] == mesh::no_label) continue;
    const Surface& surface = cover.surfaces()[owners[0]];
    areas[find_material(surface.kind).name] += area;
    if (surface.marked && owners[1] == static_cast<std::uint32_t>(Marking::paint))
      areas["paint"] += area;
    if (surface.sunken) areas["sunken"] += area;
  }
  return areas;
}

}  // namespace nightcity::ground_cover
