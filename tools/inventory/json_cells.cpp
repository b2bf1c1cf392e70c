#include "tools/inventory/json_cells.h"

#include <algorithm>
#include <array>
#include <optional>

#include "tools/cityjson/json.h"
#include "tools/inventory/coordinate_columns.h"

namespace nightcity::inventory {
namespace {

using cityjson::find_array;
using cityjson::find_member;
using cityjson::find_object;
using cityjson::find_text;
using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

constexpr int deepest = 4;  // members of members, beyond which JSON stays as it is

bool is_geojson_geometry(const object& value) {
  constexpr std::array<std::string_view, 7> kinds{
      "Point",   "MultiPoint",   "LineString",        "MultiLineString",
      "Polygon", "MultiPolygon", "GeometryCollection"};
  const std::string_view kind = find_text(value, "type");
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end() &&
         (find_array(value, "coordinates") || find_array(value, "geometries"));
}

// Returns the text of a single value; none for lists and objects.
std::optional<std::string> to_cell(const element& value) {
  if (value.is_null()) return "";
  if (bool truth = false; value.get(truth) == simdjson::SUCCESS) return truth ? "yes" : "no";
  if (value.is_object() || value.is_array()) return {};
  return cityjson::to_text(value);
}

// A point is WKT, which is found in columns of any name; other geometries stay as they are.
std::string to_geometry(const object& geometry) {
  const auto position = find_array(geometry, "coordinates");
  if (find_text(geometry, "type") != "Point" || !position) return simdjson::minify(geometry);
  std::string numbers;
  std::size_t count = 0;
  for (const element& number : *position) {
    if (++count > 2) break;
    numbers += (numbers.empty() ? "" : " ") + cityjson::to_text(number);
  }
  return count < 2 ? "" : "POINT (" + numbers + ")";
}

// Two numbers under the name of a place stay a list, whose order its reader tells.
std::string join(const array& values, const std::string& name) {
  std::string text;
  std::vector<std::string> parts;
  for (const element& value : values) {
    const auto cell = to_cell(value);
    if (!cell) return simdjson::minify(values);
    parts.push_back(*cell);
  }
  const bool are_two_numbers =
      parts.size() == 2 && std::all_of(values.begin(), values.end(), [](const element& value) {
        return cityjson::to_number(value).has_value();
      });
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return are_two_numbers && is_name_of_points(name) ? "[" + text + "]" : text;
}

class RowReader {
 public:
  RowReader(const std::vector<ListedColumn>& columns, const VisitCell& use,
            const std::function<void()>& end_row, PlacesInRows& places)
      : columns_(columns), use_(use), end_row_(end_row), places_(places) {}

  void read(const element& row) const {
    array values;
    object members;
    if (row.get(values) == simdjson::SUCCESS) {
      read_values(values);
    } else if (row.get(members) == simdjson::SUCCESS) {
      if (const auto features = find_array(members, "features")) {
        for (const element& feature : *features)
          if (feature.is_object()) read(feature);
        return;
      }
      read_members(members, "", 0);
    }
    end_row_();
  }

 private:
  void read_values(const array& values) const {
    std::size_t at = 0;
    for (const element& value : values) {
      if (at == columns_.size()) return;
      const ListedColumn& column = columns_[at++];
      array parts;
      if (column.parts.empty() || value.get(parts) != simdjson::SUCCESS) {
        read_value(value, column.name, 0);
        continue;
      }
      std::size_t part = 0;
      for (const element& one : parts)
        if (part < column.parts.size())
          read_value(one, column.name + "." + column.parts[part++], 1);
    }
  }

  void read_members(const object& members, const std::string& prefix, int depth) const {
    for (const auto& [key, value] : members) {
      const std::string name(key);
      object inner;
      const bool is_wrapping = depth == 0 && (name == "properties" || name == "attributes" ||
                                              name == "fields" || name == "_source");
      if (is_wrapping && value.get(inner) == simdjson::SUCCESS)
        read_members(inner, "", 1);
      else
        read_value(value, prefix + name, depth + 1);
    }
  }

  void read_value(const element& value, const std::string& name, int depth) const {
    object members;
    array values;
    if (const auto cell = to_cell(value)) {
      use_(name, *cell);
    } else if (value.get(values) == simdjson::SUCCESS) {
      use_(name, join(values, name));
    } else if (value.get(members) == simdjson::SUCCESS) {
      if (find_text(members, "type") == "Feature")
        if (const auto geometry = find_object(members, "geometry")) members = *geometry;
      if (is_geojson_geometry(members)) {
        places_.has_geojson = true;
        use_(name, to_geometry(members));
      } else if (depth < deepest) {
        read_members(members, name + ".", depth);
      } else {
        use_(name, simdjson::minify(value));
      }
    }
  }

  const std::vector<ListedColumn>& columns_;
  const VisitCell& use_;
  const std::function<void()>& end_row_;
  PlacesInRows& places_;
};

}  // namespace

void visit_cells(const element& row, const std::vector<ListedColumn>& columns, const VisitCell& use,
                 const std::function<void()>& end_row, PlacesInRows& places) {
  RowReader(columns, use, end_row, places).read(row);
}

}  // namespace nightcity::inventory
