// Tables of numbers: CSV for programs, Markdown for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nightcity::measure {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // one cell per column

  /// Returns the index of a column. Throws Error with its name when there is none.
  std::size_t column(const std::string& name) const;
};

/// Writes comma-separated values with quotes where needed (RFC 4180) and a header line. A temporary
/// file is written beside `path` and renamed.
void write_csv(const std::filesystem::path& path, const Table& table);

/// Reads any CSV with a header and rows of equal length. Throws Error with the line.
Table read_csv(const std::filesystem::path& path);

/// Returns the table as Markdown; columns of numbers are aligned right.
std::string to_markdown(const Table& table);

}  // namespace nightcity::measure
