#include "tools/georeference/handedness.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace nightcity::georeference {
namespace {

struct Facet {
  double up;      // z of the area vector: positive when the ring runs counter-clockwise in x, y
  double height;  // mean z
};

std::vector<Facet> to_facets(std::span<const glm::dvec3> points) {
  std::vector<Facet> facets;
  std::size_t first = 0;
  while (first + 3 < points.size()) {
    std::size_t last = first + 1;
    while (last < points.size() && points[last] != points[first]) ++last;
    if (last == points.size()) break;  // not closed: not a ring
    Facet facet{0, 0};
    for (std::size_t i = first; i < last; ++i) {
      const glm::dvec3 a = points[i] - points[first], b = points[i + 1] - points[first];
      facet.up += 0.5 * (a.x * b.y - a.y * b.x);
      facet.height += points[i].z / static_cast<double>(last - first);
    }
    if (std::isfinite(facet.up) && std::isfinite(facet.height)) facets.push_back(facet);
    first = last + 1;
  }
  return facets;
}

}  // namespace

double handedness(std::span<const glm::dvec3> closed_rings) {
  const std::vector<Facet> facets = to_facets(closed_rings);
  double up = 0, total = 0, height = 0;
  for (const Facet& f : facets) {
    up += f.up;
    total += std::abs(f.up);
    height += std::abs(f.up) * f.height;
  }
  if (!(total > 0)) return 0;
  constexpr double all_face_one_way = 0.9;
  // Terrain, roads or roofs alone: they face up.
  if (std::abs(up) > all_face_one_way * total) return up / total;
  // Solids: by the divergence theorem of the field (0, 0, z) the facets' heights give the volume.
  // Its sign is the answer.
  height /= total;
  double volume = 0, magnitude = 0;
  for (const Facet& f : facets) {
    volume += f.up * (f.height - height);
    magnitude += std::abs(f.up * (f.height - height));
  }
  return magnitude > 0 ? volume / magnitude : 0;
}

}  // namespace nightcity::georeference
