#include "tools/inventory/json_table.h"

#include <array>
#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/cityjson/json.h"
#include "tools/inventory/json_cells.h"
#include "tools/inventory/json_pages.h"
#include "tools/inventory/json_rows.h"
#include "tools/inventory/memory_folder.h"

namespace nightcity::inventory {
namespace {

using simdjson::dom::element;

constexpr std::size_t most_columns = 2000;  // as many as GDAL reads of a CSV

void append_cell(std::string_view text, std::string& csv) {
  csv += '"';
  for (const char c : text) {
    if (c == '"') csv += '"';
    if (c != '\0') csv += c;
  }
  csv += '"';
}

// The columns in the order in which rows name them first.
class Headings {
 public:
  explicit Headings(std::string file) : file_(std::move(file)) {}
  void add(const std::string& name) {
    if (!numbers_.try_emplace(name, names_.size()).second) return;
    names_.push_back(name);
    if (names_.size() > most_columns)
      throw Error(file_, "has rows in JSON with more than " + std::to_string(most_columns) +
                             " different names: save it as CSV with the columns that are needed");
  }
  std::size_t find(const std::string& name) const { return numbers_.at(name); }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::string file_;
  std::unordered_map<std::string, std::size_t> numbers_;
  std::vector<std::string> names_;
};

// Counts the rows in `written`.
std::string write_csv(JsonRows& rows, const std::string& file, PlacesInRows& places,
                      std::size_t& written) {
  Headings headings(file);
  const auto nothing = [] {};
  rows.visit([&](const element& row) {
    visit_cells(
        row, rows.columns(),
        [&](const std::string& name, const std::string&) { headings.add(name); }, nothing, places);
  });
  std::string csv;
  const auto append_line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) csv += ',';
      append_cell(cells[i], csv);
    }
    // GDAL takes a single column for text.
    csv += cells.size() == 1 ? ",\n" : "\n";
    if (csv.size() > most_whole_bytes)
      throw Error(file,
                  "makes a table of more than 1 GB of its JSON: save it as CSV with the "
                  "columns that are needed");
  };
  if (headings.names().empty()) return csv;
  append_line(headings.names());
  std::vector<std::string> cells(headings.names().size());
  rows.visit([&](const element& row) {
    visit_cells(
        row, rows.columns(),
        [&](const std::string& name, std::string text) {
          cells[headings.find(name)] = std::move(text);
        },
        [&] {
          append_line(cells);
          ++written;
          for (std::string& cell : cells) cell.clear();
        },
        places);
  });
  return csv;
}

// ArcGIS names the CRS by a number of the register or of its own, or by its definition.
std::string find_esri_crs(const simdjson::dom::object& wrapper) {
  const auto system = cityjson::find_object(wrapper, "spatialReference");
  if (!system) return {};
  constexpr std::size_t least_of_esri = 37000;
  constexpr std::array<std::size_t, 3> web_mercator{102100, 102113, 900913};
  for (const char* key : {"latestWkid", "wkid"})
    if (const auto value = cityjson::find_member(*system, key))
      if (const auto number = cityjson::to_index(*value)) {
        for (const std::size_t web : web_mercator)
          if (*number == web) return "EPSG:3857";
        return (*number < least_of_esri ? "EPSG:" : "ESRI:") + std::to_string(*number);
      }
  return std::string(cityjson::find_text(*system, "wkt"));
}

}  // namespace

JsonTable read_json_table(std::string text, const std::string& file, std::string& why) {
  JsonTable table;
  JsonRows rows(std::move(text), file);
  why = rows.why_none();
  if (!why.empty()) return table;
  PlacesInRows places;
  std::size_t written = 0;
  table.csv = write_csv(rows, file, places, written);
  if (places.has_geojson) table.crs = "OGC:CRS84";
  if (!rows.wrapper()) return table;
  if (const std::string crs = find_esri_crs(*rows.wrapper()); !crs.empty()) table.crs = crs;
  for (const simdjson::dom::object* beside : {rows.wrapper(), rows.whole()})
    if (table.incomplete.empty()) table.incomplete = find_missing_rows(*beside, written);
  return table;
}

}  // namespace nightcity::inventory
