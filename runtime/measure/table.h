// Tables of figures: CSV for programs, Markdown for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nightcity {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // as many cells each as there are columns

  /// Index of a column; throws Error naming it where there is none.
  std::size_t column(const std::string& name) const;
};

/// Comma-separated with quotes where needed (RFC 4180), a header line first. Written beside and renamed.
void write_csv(const std::filesystem::path& path, const Table& table);

/// Reads what write_csv wrote, or any CSV with a header and rows of equal length. Throws Error with the line.
Table read_csv(const std::filesystem::path& path);

/// Cells that are numbers are set flush right.
std::string to_markdown(const Table& table);

}  // namespace nightcity
