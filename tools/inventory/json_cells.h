// The cells of one row in JSON: members of members side by side, points as a table writes them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/inventory/json_rows.h"

namespace nightcity::inventory {

/// Called with the name of a column and a cell's text.
using VisitCell = std::function<void(const std::string&, std::string)>;

/// Facts that rows tell of all of their places.
struct PlacesInRows {
  bool has_geojson = false;  // some are GeoJSON, which is in WGS 84 (RFC 7946)
};

/// Visits the cells of a row. A feature's properties, ArcGIS' attributes, OpenDataSoft's fields and
/// Elasticsearch's _source are columns of their own; other members of members have their names
/// behind a point. A list of features is as many rows: `end_row` is called behind each.
void visit_cells(const simdjson::dom::element& row, const std::vector<ListedColumn>& columns,
                 const VisitCell& use, const std::function<void()>& end_row, PlacesInRows& places);

}  // namespace nightcity::inventory
