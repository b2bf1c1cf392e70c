#include "tools/inventory/row_places.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

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

int find_zone_column(OGRLayer& layer) {
  constexpr std::array<std::string_view, 8> names{"zone",    "utmzone", "zoneutm", "zonautm",
                                                  "utmzona", "utm",     "huso",    "fuso"};
  OGRFeatureDefn& columns = *layer.GetLayerDefn();
  for (int i = 0; i < columns.GetFieldCount(); ++i) {
    std::string name = to_lower(columns.GetFieldDefn(i)->GetNameRef());
    std::erase_if(name, [](char c) { return c == ' ' || c == '_' || c == '-'; });
    if (std::find(names.begin(), names.end(), name) != names.end()) return i;
  }
  return -1;
}

std::optional<int> read_utm_zone(const OGRFeature& row, int column) {
  constexpr int most = 60;
  const std::string_view text = city::trim(row.GetFieldAsString(column));
  int zone = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), zone);
  const auto behind = text.data() + text.size() - end;
  const bool is_band =
      behind == 1 && ((*end >= 'A' && *end <= 'Z') || (*end >= 'a' && *end <= 'z'));
  const bool needs_band = to_lower(row.GetFieldDefnRef(column)->GetNameRef()) == "zone";
  if (error != std::errc() || zone < 1 || zone > most) return {};
  if (!is_band && (behind != 0 || needs_band)) return {};
  return zone;
}

}  // namespace nightcity::inventory
