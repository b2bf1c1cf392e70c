#include "tools/lights/ies_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "formats/error.h"
#include "formats/to_lower.h"

namespace nightcity::lights {
namespace {

constexpr int max_ies_angles = 20000;
constexpr double foot_m = 0.3048;

enum class Comma { separates, decimal };

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Reads numbers one after another, each with the number of its line.
class Numbers {
 public:
  Numbers(const TextLines& lines, std::size_t first_line, Comma comma)
      : lines_(lines), line_(first_line), separators_(comma == Comma::separates ? " \t," : " \t") {}

  double next(std::string_view what) {
    const std::string_view text = token(what);
    return lines_.number(text, at_, what);
  }
  int next_integer(std::string_view what, int low, int high) {
    const std::string_view text = token(what);
    return lines_.integer(text, at_, what, low, high);
  }
  /// Reads ascending angles.
  std::vector<double> angles(int count, std::string_view what) {
    std::vector<double> result;
    for (int n = 0; n < count; ++n) {
      result.push_back(next(what));
      if (n > 0 && result[result.size() - 1] <= result[result.size() - 2])
        lines_.fail(at_, std::string(what) + " do not ascend");
    }
    return result;
  }
  /// Throws where numbers remain: they belong to a table of another size than the counts say.
  /// Returns whether other text does.
  bool expect_end() {
    const std::string_view text = find_token();
    if (text.empty()) return false;
    if (is_digit(text.front()) || text.front() == '-' || text.front() == '.')
      lines_.fail(at_, "numbers remain after the last candela value (\"" +
                           std::string(text.substr(0, 40)) +
                           "\"): the table is larger than the numbers of angles say");
    return true;
  }
  std::size_t line() const { return at_; }

 private:
  /// Returns the next word; empty at the end of the file.
  std::string_view find_token() {
    while (true) {
      const std::size_t first = rest_.find_first_not_of(separators_);
      if (first != std::string_view::npos) {
        rest_.remove_prefix(first);
        const std::size_t end = std::min(rest_.find_first_of(separators_), rest_.size());
        std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(end);
        while (text.starts_with(',')) text.remove_prefix(1);
        while (text.ends_with(',')) text.remove_suffix(1);
        if (!text.empty()) return text;
        continue;
      }
      if (line_ >= lines_.all().size()) return {};
      rest_ = lines_.all()[line_].text;
      at_ = lines_.all()[line_].number;
      ++line_;
    }
  }
  std::string_view token(std::string_view what) {
    const std::string_view text = find_token();
    if (text.empty())
      lines_.fail(lines_.all().back().number,
                  "the file ends where " + std::string(what) + " should stand");
    return text;
  }

  const TextLines& lines_;
  std::size_t line_, at_ = 0;
  std::string_view separators_, rest_;
};

IesTable read_table(const TextLines& lines, std::size_t first, bool has_tilt_table, int year,
                    Comma comma) {
  Numbers numbers(lines, first, comma);
  if (has_tilt_table) {
    // The TILT data say how the lamp's output falls when the luminaire is tilted. Ours hang as
    // they were measured.
    numbers.next_integer("the lamp's position", 1, 3);
    const int pairs = numbers.next_integer("the number of tilt angles", 1, max_ies_angles);
    for (int n = 0; n < 2 * pairs; ++n) numbers.next("the tilt table");
  }
  IesTable table;
  const double lamps = numbers.next("the number of lamps"), lumens = numbers.next("lumens a lamp");
  const double multiplier = numbers.next("the candela multiplier");
  const int vertical = numbers.next_integer("the number of vertical angles", 2, max_ies_angles);
  const int horizontal = numbers.next_integer("the number of horizontal angles", 1, max_ies_angles);
  const auto total = static_cast<std::size_t>(vertical) * static_cast<std::size_t>(horizontal);
  if (total > 4'000'000) lines.fail(numbers.line(), "more angles than any file has");
  table.type = numbers.next_integer("the photometric type", 1, 3);
  const double unit = numbers.next_integer("the unit (1 feet, 2 metres)", 1, 2) == 1 ? foot_m : 1;
  // Negative sizes stand for round openings (LM-63-2002).
  table.width_m = std::abs(numbers.next("the width")) * unit;
  table.length_m = std::abs(numbers.next("the length")) * unit;
  table.height_m = std::abs(numbers.next("the height")) * unit;
  double scale = multiplier * numbers.next("the ballast factor");
  // LM-63-2019 has the file generation type here, a code like 1.10000 for an accredited laboratory.
  if (year >= 2019) {
    numbers.next("the file generation type");
  } else {
    // LM-63-1995 and 2002 keep the place "for future use": some programs write 0 there, which is no
    // factor.
    const double factor = numbers.next("the ballast-lamp factor");
    scale *= year >= 1995 && factor == 0 ? 1 : factor;
  }
  numbers.next("input watts");
  if (!(scale > 0)) lines.fail(numbers.line(), "multiplier and factors must be above zero");
  table.vertical = numbers.angles(vertical, "vertical angles");
  table.vertical_line = numbers.line();
  table.horizontal = numbers.angles(horizontal, "horizontal angles");
  table.horizontal_line = numbers.line();
  table.candela.reserve(total);
  for (std::size_t n = 0; n < total; ++n) {
    const double candela = numbers.next("candela values");
    if (candela < 0) lines.fail(numbers.line(), "negative candela");
    table.candela.push_back(candela * scale);
  }
  table.last_line = numbers.line();
  table.has_text_after = numbers.expect_end();
  table.stated_flux_lm = lamps > 0 && lumens > 0 ? lamps * lumens : 0;
  return table;
}

/// Returns whether a comma stands between two digits anywhere from line `first` on.
bool has_inner_comma(const TextLines& lines, std::size_t first) {
  for (std::size_t n = first; n < lines.all().size(); ++n) {
    const std::string_view text = lines.all()[n].text;
    for (std::size_t i = 1; i + 1 < text.size(); ++i)
      if (text[i] == ',' && is_digit(text[i - 1]) && is_digit(text[i + 1])) return true;
  }
  return false;
}

}  // namespace

int find_lm63_year(std::string_view line) {
  constexpr std::string_view standard = "lm-63-";
  constexpr int oldest = 1986;
  const std::string first_line = to_lower(line);
  std::size_t at = first_line.find(standard);
  if (at != std::string_view::npos)
    at += standard.size();
  else if (first_line.starts_with("iesna"))
    at = 5;
  else
    return oldest;
  int year = 0;
  for (std::size_t n = 0; n < 4 && at + n < first_line.size() && is_digit(first_line[at + n]); ++n)
    year = 10 * year + first_line[at + n] - '0';
  if (year == 0) return oldest;
  if (year < 100) year += year < oldest - 1900 ? 2000 : 1900;
  return std::max(year, oldest);
}

IesTable read_ies_table(const TextLines& lines, std::size_t first, bool has_tilt_table, int year) {
  try {
    return read_table(lines, first, has_tilt_table, year, Comma::separates);
  } catch (const Error&) {
    if (!has_inner_comma(lines, first)) throw;
    try {
      return read_table(lines, first, has_tilt_table, year, Comma::decimal);
    } catch (const Error&) {
    }
    throw;  // with the first reading's line
  }
}

}  // namespace nightcity::lights
