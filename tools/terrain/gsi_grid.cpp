#include "tools/terrain/gsi_grid.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/attributes.h"

namespace nightcity::terrain {
namespace {

constexpr std::string_view blanks_of_xml = " \t\r\n";

// Returns the text of the first element of that name, whatever its prefix; "" without.
std::string_view find_element(std::string_view text, const std::string& name) {
  for (std::size_t at = text.find(name + ">"); at != text.npos;
       at = text.find(name + ">", at + 1)) {
    if (at == 0 || (text[at - 1] != ':' && text[at - 1] != '<')) continue;
    const std::size_t begin = at + name.size() + 1, end = text.find("</", begin);
    return end == text.npos ? std::string_view() : text.substr(begin, end - begin);
  }
  return {};
}

// Takes the next number; false where there is none.
bool take_number(std::string_view& text, double& number) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks_of_xml), text.size()));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

std::array<double, 2> find_pair(std::string_view text, const std::string& element,
                                const std::string& name) {
  std::string_view found = find_element(text, element);
  std::array<double, 2> pair{};
  if (!take_number(found, pair[0]) || !take_number(found, pair[1]))
    throw Error(name, "is an elevation model of GSI without " + element + ": fetch it again");
  return pair;
}

std::string to_plain(double number) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

}  // namespace

bool is_named_as_gsi_grid(std::string_view name) {
  const std::string lower = to_lower(name.substr(name.find_last_of("/\\") + 1));
  return lower.starts_with("fg-gml-") && lower.find("-dem") != lower.npos &&
         lower.ends_with(".xml");
}

GsiGrid read_gsi_grid(std::string_view text, const std::string& name) {
  constexpr double most_points = 4e6;  // a tile has 225 x 150 or 1125 x 750
  constexpr const char* nothing = "-9999";
  const auto south_west = find_pair(text, "lowerCorner", name),
             north_east = find_pair(text, "upperCorner", name);
  const auto low = find_pair(text, "low", name), high = find_pair(text, "high", name);
  const double width = high[0] - low[0] + 1, height = high[1] - low[1] + 1;
  const bool are_whole = std::floor(width) == width && std::floor(height) == height;
  if (!(are_whole && width >= 1 && height >= 1 && width * height <= most_points))
    throw Error(name, "is an elevation model of GSI of " + to_plain(width) + " x " +
                          to_plain(height) + " points, which no tile has");
  // All tiles begin in the north west; in another order the heights would be turned over.
  if (const std::size_t order = text.find("order=\"");
      order != text.npos && !text.substr(order).starts_with("order=\"+x-y\""))
    throw Error(name, "is an elevation model of GSI whose heights are in another order than +x-y");
  const auto start = find_pair(text, "startPoint", name);
  const double first = start[1] * width + start[0], points = width * height;
  if (!(first >= 0 && first <= points))
    throw Error(name, "is an elevation model of GSI that begins outside of its grid");
  GsiGrid made;
  made.grid = "ncols " + to_plain(width) + "\nnrows " + to_plain(height) + "\nxllcorner " +
              to_plain(south_west[1]) + "\nyllcorner " + to_plain(south_west[0]) + "\ndx " +
              to_plain((north_east[1] - south_west[1]) / width) + "\ndy " +
              to_plain((north_east[0] - south_west[0]) / height) + "\nNODATA_value " + nothing +
              "\n";
  const auto columns = static_cast<std::size_t>(width);
  std::size_t count = 0;
  const auto add = [&](std::string_view value) {
    made.grid += value;
    made.grid += ++count % columns == 0 ? '\n' : ' ';
  };
  while (count < static_cast<std::size_t>(first)) add(nothing);
  std::string_view rest = find_element(text, "tupleList");
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = city::trim(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty()) continue;
    // The kind of surface stands before the comma, in whatever encoding.
    std::string_view value = line.substr(line.rfind(',') + 1);
    double metres = 0;
    if (count >= static_cast<std::size_t>(points))
      throw Error(name, "is an elevation model of GSI with more heights than its grid has points");
    add(take_number(value, metres) ? to_plain(metres) : nothing);
  }
  while (count < static_cast<std::size_t>(points)) add(nothing);
  // JGD2011 and, with the same plan, JGD2024.
  made.crs = text.find("jgd2000") != text.npos ? "EPSG:4612" : "EPSG:6668";
  return made;
}

}  // namespace nightcity::terrain
