// Tables in JSON that is no GeoJSON, as the servers of portals answer.
#pragma once

#include <string>

namespace nightcity::inventory {

struct JsonTable {
  std::string csv;         // headings and rows, each cell in quotation marks
  std::string crs;         // that its places are in by their form; "": it names none
  std::string incomplete;  // what the server left out; "": nothing
};

/// Turns rows of JSON into those of a CSV: a list of objects, one that is a member of an object
/// (OpenDataSoft, CKAN, ArcGIS, OData, ...), an object a line, lists of values beside the names of
/// their columns (Socrata). Members of members have columns with a point in their names
/// ("location.latitude"); points of GeoJSON are WKT. `why` says why a text is none of these; it is
/// "" where a table was found. Throws Error where the text is broken or its table is too large.
JsonTable read_json_table(std::string text, const std::string& file, std::string& why);

}  // namespace nightcity::inventory
