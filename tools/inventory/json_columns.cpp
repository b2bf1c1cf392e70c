#include "tools/inventory/json_columns.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/cityjson/json.h"
#include "tools/inventory/coordinate_columns.h"
#include "tools/inventory/memory_folder.h"

namespace nightcity::inventory {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

object to_object(const element& value) {
  object members;
  if (value.get(members) != simdjson::SUCCESS) return {};
  return members;
}

std::vector<std::string> list_names(const object& members) {
  std::vector<std::string> names;
  for (const auto& [name, value] : members) names.emplace_back(name);
  return names;
}

bool are_numbers(const std::vector<std::string>& names) {
  return std::all_of(names.begin(), names.end(), [](const std::string& name) {
    return !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
  });
}

std::string quote(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    constexpr const char* digits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ') {
      (out += "\\u00") += digits[byte >> 4];
      out += digits[byte & 15];
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + '"';
}

class RowWriter {
 public:
  explicit RowWriter(const std::string& file) : file_(file) {}
  void add(std::string_view text) {
    text_ += text;
    if (text_.size() > most_whole_bytes)
      throw Error(file_,
                  "makes rows of more than 1 GB of its JSON: save it as CSV with the columns that "
                  "are needed");
  }
  std::string take() { return std::move(text_); }

 private:
  const std::string& file_;
  std::string text_;
};

// A table whose cells are found by row and column.
struct Columns {
  std::vector<std::string> names;
  std::vector<std::string> rows;              // their names; empty: they have none
  std::vector<std::vector<element>> columns;  // of each, its cells
  std::vector<std::vector<bool>> has;
};

std::string write_columns(const Columns& table, std::size_t rows, const std::string& file) {
  RowWriter out(file);
  out.add("{\"columns\":[\"index\"");
  for (const std::string& name : table.names) out.add("," + quote(name));
  out.add("],\"data\":[");
  for (std::size_t row = 0; row < rows; ++row) {
    out.add((row > 0 ? ",[" : "[") +
            (table.rows.empty() ? std::to_string(row) : quote(table.rows[row])));
    for (std::size_t column = 0; column < table.columns.size(); ++column)
      out.add("," + (table.has[column][row] ? simdjson::minify(table.columns[column][row])
                                            : std::string("null")));
    out.add("]");
  }
  out.add("]}");
  return out.take();
}

// Columns of values by the names of rows, which may be in another order in each.
std::string turn_objects(const object& table, const std::string& file) {
  Columns found;
  std::unordered_map<std::string, std::size_t> numbers;
  std::size_t cells_there_are = 0;
  for (const auto& [name, value] : table)
    for (const std::string& row : list_names(to_object(value))) {
      ++cells_there_are;
      if (numbers.try_emplace(row, found.rows.size()).second) found.rows.push_back(row);
    }
  // Columns that have no rows in common are no table, and would be a large one.
  constexpr std::size_t most_empty = 10, few = 10'000;
  if (table.size() * found.rows.size() > most_empty * cells_there_are + few) return {};
  for (const auto& [name, value] : table) {
    found.names.emplace_back(name);
    auto& cells = found.columns.emplace_back(found.rows.size());
    auto& has = found.has.emplace_back(found.rows.size(), false);
    for (const auto& [row, cell] : to_object(value)) {
      const std::size_t number = numbers.at(std::string(row));
      cells[number] = cell;
      has[number] = true;
    }
  }
  return write_columns(found, found.rows.size(), file);
}

// Columns that are lists of the same length; what else the object holds is about the table.
std::string turn_lists(const object& table, const std::string& file) {
  Columns found;
  std::size_t rows = 0;
  for (const auto& [name, value] : table) {
    array list;
    if (value.get(list) != simdjson::SUCCESS || list.size() == 0) continue;
    if (rows == 0) rows = list.size();
    if (list.size() != rows) return {};
    found.names.emplace_back(name);
    found.columns.emplace_back(list.begin(), list.end());
    found.has.emplace_back(rows, true);
  }
  return have_names_of_places(found.names) ? write_columns(found, rows, file) : "";
}

std::string turn_named_rows(const object& rows, const std::string& file) {
  RowWriter out(file);
  out.add("[");
  bool is_first = true;
  for (const auto& [name, value] : rows) {
    const object cells = to_object(value);
    const bool has_index = cells.at_key("index").error() == simdjson::SUCCESS;
    out.add((is_first ? "{" : ",{") + quote(has_index ? "name" : "index") + ":" + quote(name));
    for (const auto& [key, cell] : cells) out.add("," + quote(key) + ":" + simdjson::minify(cell));
    out.add("}");
    is_first = false;
  }
  out.add("]");
  return out.take();
}

bool is_row(const object& members) {
  const bool are_values = std::all_of(members.begin(), members.end(), [](const auto& member) {
    return !member.value.is_object() && !member.value.is_array();
  });
  return are_values && have_names_of_places(list_names(members));
}

std::string turn_table(const object& table, const std::string& file) {
  if (table.size() == 0) return {};
  const bool are_objects = std::all_of(table.begin(), table.end(),
                                       [](const auto& member) { return member.value.is_object(); });
  if (!are_objects) return turn_lists(table, file);
  const object first = to_object((*table.begin()).value);
  if (first.size() == 0) return {};
  const std::vector<std::string> outer = list_names(table), inner = list_names(first);
  const bool holds_objects = (*first.begin()).value.is_object();
  if (have_names_of_places(outer) || (are_numbers(inner) && !are_numbers(outer) && !holds_objects))
    return turn_objects(table, file);
  if (have_names_of_places(inner) || (are_numbers(outer) && !are_numbers(inner)))
    return turn_named_rows(table, file);
  return {};
}

}  // namespace

std::string turn_into_rows(const object& whole, const std::string& file) {
  // City models and maps in JSON hold their objects by name, too.
  for (const std::string_view type : {"CityJSON", "CityJSONFeature", "Topology"})
    if (cityjson::find_text(whole, "type") == type) return {};
  if (is_row(whole)) return "[" + simdjson::minify(whole) + "]";
  if (std::string rows = turn_table(whole, file); !rows.empty()) return rows;
  // A member alone that is a place may be the middle of a map.
  std::string found, found_in;
  for (const auto& [name, value] : whole) {
    std::string rows = value.is_object() ? turn_table(to_object(value), file) : "";
    if (rows.empty()) continue;
    if (!found.empty())
      throw Error(file, "holds several tables (" + found_in + ", " + std::string(name) +
                            ", ...): save that of the lamps alone");
    found = std::move(rows);
    found_in = name;
  }
  return found;
}

}  // namespace nightcity::inventory
