#include "tools/inventory/table_text.h"

#include <algorithm>
#include <utility>

#include "formats/to_lower.h"
#include "tools/city/foreign_format.h"

namespace nightcity::inventory {
namespace {

constexpr std::string_view utf8_mark = "\xef\xbb\xbf";
constexpr std::string_view double_prime = "\xe2\x80\xb3";

// Returns whether a table begins with the line that tells Excel which sign separates its columns.
bool begins_with_separator(std::string_view text) {
  if (text.starts_with(utf8_mark)) text.remove_prefix(utf8_mark.size());
  return to_lower(text.substr(0, 4)) == "sep=";
}

// Returns whether bars separate the columns of a table, which GDAL takes for text: its first line
// has no other separator.
bool has_bars(std::string_view text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  return line.find('|') != line.npos && line.find_first_of(",;\t") == line.npos;
}

// Returns whether a table begins with lines of nothing, in which GDAL finds no column.
bool begins_with_blank_line(std::string_view text) {
  if (text.starts_with(utf8_mark)) text.remove_prefix(utf8_mark.size());
  const std::size_t first = text.find_first_not_of(" \t");
  return first != text.npos && (text[first] == '\r' || text[first] == '\n');
}

// Returns whether a table begins with a line behind '#' that is no heading: another follows, or one
// of more columns.
bool begins_with_comment(std::string_view text) {
  if (!text.starts_with('#')) return false;
  const std::size_t end = text.find('\n');
  if (end == text.npos) return false;
  const auto count = [](std::string_view line) {
    return std::count_if(line.begin(), line.end(),
                         [](char c) { return c == ',' || c == ';' || c == '|' || c == '\t'; });
  };
  const std::string_view next = text.substr(end + 1);
  return next.starts_with('#') ||
         count(text.substr(0, end)) < count(next.substr(0, next.find('\n')));
}

// Makes tabs of bars but for those in quotation marks.
void replace_bars(std::string& text) {
  bool quoted = false;
  for (char& c : text) {
    if (c == '"') quoted = !quoted;
    if (c == '|' && !quoted) c = '\t';
  }
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

constexpr std::string_view borders = ",;|\t\r\n";  // of cells

// Returns whether the cell ends behind a quotation mark at `at`.
bool ends_cell(std::string_view text, std::size_t at) {
  const std::size_t next = text.find_first_not_of(' ', at + 1);
  return next == text.npos || borders.find(text[next]) != borders.npos;
}

// Returns the place of the next quotation mark that stands behind a number in a cell which does not
// begin with one, or alone within a cell that does ("a 5" pole"); npos without. GDAL would take all
// up to the next such mark for one cell. `quoted` says whether a quoted cell goes on at `at`.
std::size_t find_stray_mark(std::string_view text, std::size_t at, bool& quoted) {
  for (at = text.find('"', at); at != text.npos; at = text.find('"', at + 1)) {
    if (quoted) {
      const bool is_doubled = at + 1 < text.size() && text[at + 1] == '"';
      if (is_doubled)
        ++at;
      else if (ends_cell(text, at))
        quoted = false;
      else
        return at;
      continue;
    }
    std::size_t before = at;
    while (before > 0 && text[before - 1] == ' ') --before;
    if (before == 0 || borders.find(text[before - 1]) != borders.npos ||
        text.substr(0, before) == utf8_mark)
      quoted = true;
    else if (is_digit(text[before - 1]))
      return at;
  }
  return text.npos;
}

void replace_stray_marks(std::string& text) {
  bool quoted = false;
  std::size_t at = find_stray_mark(text, 0, quoted), copied = 0;
  if (at == text.npos) return;
  std::string out;
  for (; at != text.npos; at = find_stray_mark(text, at + 1, quoted)) {
    out.append(text, copied, at - copied);
    out += double_prime;
    copied = at + 1;
  }
  out.append(text, copied);
  text = std::move(out);
}

// Returns whether a table has a single column, which GDAL takes for text.
bool has_one_column(std::string_view text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  return line.size() < text.size() && line.find_first_of(",;|\t") == line.npos &&
         line.find('\0') == line.npos && city::name_foreign(text, "").empty();
}

// Returns the place of the next cell that begins with '=' and a quotation mark, by which programs
// keep Excel from changing a value: ="13.4". npos without.
std::size_t find_formula(std::string_view text, std::size_t at) {
  for (at = text.find("=\"", at); at != text.npos; at = text.find("=\"", at + 1))
    if (at == 0 || borders.find(text[at - 1]) != borders.npos) return at;
  return text.npos;
}

void drop_formulas(std::string& text) {
  std::size_t at = find_formula(text, 0), copied = 0;
  if (at == text.npos) return;
  std::string out;
  for (; at != text.npos; at = find_formula(text, at + 1)) {
    out.append(text, copied, at - copied);
    copied = at + 1;
  }
  out.append(text, copied);
  text = std::move(out);
}

constexpr std::size_t most_of_headings = 65536;  // bytes; a mark may be without its other one

// Calls `use` with each place where a line ends within quotation marks of the headings, which GDAL
// reads by lines.
template <class Use>
void visit_quoted_line_ends(std::string_view text, const Use& use) {
  bool quoted = false;
  for (std::size_t i = 0; i < std::min(text.size(), most_of_headings); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] != '\n' && text[i] != '\r') continue;
    if (!quoted) return;
    use(i);
  }
}

bool has_quoted_line_end(std::string_view text) {
  bool has_one = false;
  visit_quoted_line_ends(text, [&](std::size_t) { has_one = true; });
  return has_one;
}

}  // namespace

bool has_stray_marks(std::string_view text) {
  bool quoted = false;
  return find_stray_mark(text, 0, quoted) != text.npos;
}

bool is_odd_csv(std::string_view start) {
  return begins_with_separator(start) || begins_with_comment(start) || has_bars(start) ||
         begins_with_blank_line(start) || has_one_column(start) || has_stray_marks(start) ||
         find_formula(start, 0) != start.npos || has_quoted_line_end(start);
}

void straighten_csv(std::string& text) {
  if (text.starts_with(utf8_mark)) text.erase(0, utf8_mark.size());
  if (begins_with_separator(text)) text.erase(0, text.find_first_of("\r\n"));
  while (begins_with_comment(text)) text.erase(0, text.find('\n') + 1);
  while (begins_with_blank_line(text)) text.erase(0, text.find_first_of("\r\n") + 1);
  visit_quoted_line_ends(text, [&](std::size_t at) { text[at] = ' '; });
  drop_formulas(text);
  replace_stray_marks(text);
  if (has_bars(text)) replace_bars(text);
  if (has_one_column(text)) text.insert(text.find_first_of("\r\n"), "\t");
}

}  // namespace nightcity::inventory
