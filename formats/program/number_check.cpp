#include "formats/program/number_check.h"

#include <fmt/format.h>

#include "formats/number_text.h"

namespace nightcity::program {

CLI::Validator number_from(double min, double max) {
  const auto check = [min, max](const std::string& word) -> std::string {
    const auto value = read_number(word);
    if (value && *value >= min && *value <= max) return {};
    return fmt::format("'{}' is not a number from {} to {}", word, min, max);
  };
  return {check, fmt::format("in [{} - {}]", min, max)};
}

CLI::Validator count_from(std::uint64_t min, std::uint64_t max) {
  const auto check = [min, max](const std::string& word) -> std::string {
    // CLI11 reads the word once more, and would take a leading zero for the mark of octal digits.
    const auto value = word.size() > 1 && word[0] == '0' ? std::nullopt : read_count(word);
    if (value && *value >= min && *value <= max) return {};
    return fmt::format("'{}' is not a whole number from {} to {}", word, min, max);
  };
  return {check, fmt::format("in [{} - {}]", min, max)};
}

}  // namespace nightcity::program
