#include "tools/inventory/row_places.h"

namespace nightcity::inventory {

std::vector<glm::dvec2> find_places(const OGRGeometry* geometry) {
  std::vector<glm::dvec2> places;
  if (!geometry || geometry->IsEmpty()) return places;
  switch (wkbFlatten(geometry->getGeometryType())) {
    case wkbPoint: {
      const OGRPoint& point = *geometry->toPoint();
      places.emplace_back(point.getX(), point.getY());
      break;
    }
    case wkbMultiPoint:
      for (const OGRPoint* point : *geometry->toMultiPoint())
        places.emplace_back(point->getX(), point->getY());
      break;
    case wkbGeometryCollection:
      for (const OGRGeometry* part : *geometry->toGeometryCollection())
        for (const glm::dvec2& place : find_places(part)) places.push_back(place);
      break;
    default:
      break;
  }
  return places;
}

bool is_unfilled(const glm::dvec2& place) {
  return place == glm::dvec2(0);
}

}  // namespace nightcity::inventory
