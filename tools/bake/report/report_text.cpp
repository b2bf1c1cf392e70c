#include "tools/bake/report/report_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nightcity::bake {

std::string report_line(const char* name, const std::string& value) {
  return fmt::format("{:<12}{}\n", name, value);
}

std::string in_words(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, count] : sorted)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  return text.empty() ? "none" : text;
}

double round_to_tenths(double amount) {
  return std::round(10 * amount) / 10;
}

std::map<std::string, double> round_to_tenths(std::map<std::string, double> amounts) {
  for (auto& [name, amount] : amounts) amount = round_to_tenths(amount);
  return amounts;
}

}  // namespace nightcity::bake
