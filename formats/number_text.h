// Numbers as options and lists write them: a word is read as a whole or not at all, alike in every
// locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace nightcity {

/// Returns the finite decimal number that `text` is, such as -0.5, +3 or 1e-3. Blanks, a second
/// sign, hexadecimal digits, a decimal comma, infinity and NaN make it no number.
std::optional<double> read_number(std::string_view text);

/// Returns the whole number that `text` is: decimal digits alone. A leading zero is no sign of
/// octal digits.
std::optional<std::uint64_t> read_count(std::string_view text);

}  // namespace nightcity
