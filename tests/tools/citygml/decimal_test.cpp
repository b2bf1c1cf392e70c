#include "tools/decimal.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <string>

namespace nightcity {
namespace {

// std::from_chars is the oracle: value, end and error are the same.
void expect_as_from_chars(const std::string& text) {
  const char* const end = text.data() + text.size();
  double wanted = 7, value = 7;
  const auto known = std::from_chars(text.data(), end, wanted);
  const auto parsed = parse_decimal(text.data(), end, value);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(wanted)) << text;
  EXPECT_EQ(parsed.ptr, known.ptr) << text;
  EXPECT_EQ(parsed.ec, known.ec) << text;
}

TEST(Decimal, IsParsedAsByFromCharsWhateverItsDigits) {
  std::mt19937 random(17);
  std::uniform_int_distribution<int> digit('0', '9'), whole(0, 22), decimals(0, 22), coin(0, 1);
  for (int i = 0; i < 200'000; ++i) {
    std::string text = coin(random) ? "-" : "";
    for (int n = whole(random); n > 0; --n) text += static_cast<char>(digit(random));
    if (coin(random)) text += '.';
    for (int n = decimals(random); n > 0; --n) text += static_cast<char>(digit(random));
    expect_as_from_chars(text);
  }
}

TEST(Decimal, IsParsedAsByFromCharsWhereItIsNone) {
  for (const char* text : {"",
                           "-",
                           ".",
                           "-.",
                           "+1",
                           "5.",
                           ".5",
                           "-0",
                           "-0.0",
                           "1e5",
                           "1.5E-7",
                           "1e",
                           "2.e3",
                           "0x10",
                           "1,5",
                           "12.3.4",
                           "inf",
                           "nan",
                           "-inf",
                           " 1",
                           "1 2",
                           "9007199254740992",
                           "9007199254740993",
                           "900719925474099.3",
                           "0.000000000000000001",
                           "0.0000000000000000001",
                           "1e999",
                           "1e-999"})
    expect_as_from_chars(text);
}

}  // namespace
}  // namespace nightcity
