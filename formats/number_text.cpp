#include "formats/number_text.h"

#include <charconv>
#include <cmath>

namespace nightcity {
namespace {

template <typename Number>
std::optional<Number> read_whole(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
  // from_chars knows no plus, and would take the minus of "+-1".
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  const std::optional<double> value = read_whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::uint64_t> read_count(std::string_view text) {
  return read_whole<std::uint64_t>(text);
}

}  // namespace nightcity
