#include "runtime/nightview/number_check.h"

#include <fmt/format.h>

#include "formats/error.h"
#include "runtime/render/parse.h"

namespace nightcity::nightview {

CLI::Validator number_from(double min, double max) {
  const auto check = [min, max](const std::string& word) -> std::string {
    try {
      render::parse_number("", word, min, max);
    } catch (const UsageError&) {
      return fmt::format("'{}' is not a number from {} to {}", word, min, max);
    }
    return {};
  };
  return {check, fmt::format("in [{} - {}]", min, max)};
}

CLI::Validator exposure_check() {
  return number_from(-20, 40);
}

}  // namespace nightcity::nightview
