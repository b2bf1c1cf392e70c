#include "runtime/measure/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/small_file.h"

namespace nightcity::measure {
namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += csv_cell(cells[i]);
  }
  line += '\n';
  return line;
}

std::vector<std::vector<std::string>> parse_csv(const std::filesystem::path& path,
                                                const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::size_t at = 0;
  while (at < text.size()) {
    std::vector<std::string> row(1);
    bool quoted = false;
    for (; at < text.size(); ++at) {
      const char c = text[at];
      if (quoted && c == '"' && at + 1 < text.size() && text[at + 1] == '"') {
        row.back() += text[++at];
      } else if (c == '"') {
        quoted = !quoted;
      } else if (!quoted && c == ',') {
        row.emplace_back();
      } else if (!quoted && c == '\n') {
        break;
      } else if (quoted || c != '\r') {
        row.back() += c;
      }
    }
    if (quoted)
      throw Error(path.string(), fmt::format("row {}", rows.size() + 1), "a quote is not closed");
    ++at;
    rows.push_back(std::move(row));
  }
  return rows;
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

}  // namespace

std::size_t Table::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw Error({}, "the table has no column '" + name + "'");
  return static_cast<std::size_t>(found - columns.begin());
}

void write_csv(const std::filesystem::path& path, const Table& table) {
  AtomicFile file(path);
  file.write(csv_line(table.columns));
  for (const auto& row : table.rows) file.write(csv_line(row));
  file.commit();
}

Table read_csv(const std::filesystem::path& path) {
  auto rows = parse_csv(path, read_small_file(path));
  if (rows.empty()) throw Error(path.string(), "has no header");
  Table table{rows.front(),
              {std::make_move_iterator(rows.begin() + 1), std::make_move_iterator(rows.end())}};
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].size() != table.columns.size())
      throw Error(path.string(), fmt::format("row {}", i + 2),
                  fmt::format("{} cells where the header has {}", table.rows[i].size(),
                              table.columns.size()));
  return table;
}

std::string to_markdown(const Table& table) {
  std::string text = "|", rule = "|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    text += " " + table.columns[i] + " |";
    const bool numbers =
        !table.rows.empty() && std::all_of(table.rows.begin(), table.rows.end(),
                                           [&](const auto& row) { return is_number(row[i]); });
    rule += numbers ? "---:|" : "---|";
  }
  text += "\n" + rule + "\n";
  for (const auto& row : table.rows) {
    text += "|";
    for (const std::string& cell : row) text += " " + cell + " |";
    text += "\n";
  }
  return text;
}

}  // namespace nightcity::measure
