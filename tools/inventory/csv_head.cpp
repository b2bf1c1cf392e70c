#include "tools/inventory/csv_head.h"

#include <algorithm>
#include <utility>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/text_encoding.h"
#include "tools/inventory/coordinate_columns.h"

namespace nightcity::inventory {
namespace {

constexpr std::size_t most_lines = 100, most_cells = 2000;  // as many as GDAL reads
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// Returns the next line, whose cells in quotation marks may hold ends of lines.
std::string_view take_line(std::string_view& rest) {
  bool quoted = false;
  std::size_t end = 0;
  for (; end < rest.size() && (quoted || (rest[end] != '\n' && rest[end] != '\r')); ++end)
    if (rest[end] == '"') quoted = !quoted;
  const std::string_view line = rest.substr(0, end);
  if (rest.substr(end).starts_with("\r\n")) ++end;
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

std::vector<std::string> split(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  for (std::string& cell : cells) cell = city::trim(city::decode_text(cell));
  return cells;
}

std::size_t count_filled(const std::vector<std::string>& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const std::string& c) { return !c.empty(); }));
}

bool has_cell(const std::vector<std::string>& cells, const std::string& name) {
  return std::any_of(cells.begin(), cells.end(),
                     [&](const std::string& cell) { return to_lower(cell) == to_lower(name); });
}

bool names_places(const std::vector<std::string>& cells, const InventoryFile& inventory) {
  if (!inventory.x.empty()) return has_cell(cells, inventory.x) && has_cell(cells, inventory.y);
  return have_names_of_places(cells);
}

bool is_title(const std::vector<std::string>& cells, const std::vector<std::string>& headings) {
  return cells.size() != headings.size() || 2 * count_filled(cells) < count_filled(headings);
}

// Returns whether the next line has a digit in the columns that two headings name.
bool has_numbers_below(const std::vector<std::string>& headings, std::string_view rest,
                       char separator) {
  const CoordinateColumns columns = find_coordinate_columns(headings);
  if (columns.x < 0) return false;
  const std::vector<std::string> below = split(take_line(rest), separator);
  const auto has_digit = [&](int column) {
    const auto at = static_cast<std::size_t>(column);
    return at < below.size() && below[at].find_first_of("0123456789") != std::string::npos;
  };
  return has_digit(columns.x) && has_digit(columns.y);
}

}  // namespace

CsvHead find_csv_head(std::string_view text, const InventoryFile& inventory) {
  std::vector<std::string_view> before;
  std::string_view rest = text;
  for (std::size_t i = 0; i < most_lines && !rest.empty(); ++i) {
    const std::size_t begin = text.size() - rest.size();
    std::string_view line = take_line(rest);
    if (line.starts_with(byte_order_mark)) line.remove_prefix(byte_order_mark.size());
    // The line that tells Excel which sign separates the columns is no title.
    if (city::trim(line).empty() || to_lower(line.substr(0, 4)) == "sep=") continue;
    for (const char separator : {',', ';', '\t', '|'}) {
      const std::vector<std::string> cells = split(line, separator);
      if (cells.size() > most_cells || !names_places(cells, inventory)) continue;
      const bool are_titles = std::all_of(
          before.begin(), before.end(),
          [&](std::string_view above) { return is_title(split(above, separator), cells); });
      if (!are_titles && !has_numbers_below(cells, rest, separator)) return {};
      return {begin, before.size(), true};
    }
    before.push_back(line);
  }
  return {};
}

}  // namespace nightcity::inventory
