#include "formats/number_text.h"

#include <gtest/gtest.h>

namespace nightcity {
namespace {

TEST(NumberText, ANumberIsDecimalAndAWholeWord) {
  EXPECT_EQ(read_number("-0.5"), -0.5);
  EXPECT_EQ(read_number("+3"), 3);
  EXPECT_EQ(read_number("1e-3"), 1e-3);
  EXPECT_EQ(read_number(".5"), 0.5);
  EXPECT_EQ(read_number("010"), 10);
  for (const char* text : {"",   " ",     "+",   "-",    "+-1",  "-+1",    "++1",   " 1",
                           "1 ", "\t1",   "1\n", "1,5",  "0x10", "0x1p3",  "1'000", "1_000",
                           "1e", "1e999", "inf", "-inf", "nan",  "nan(1)", "1.2.3", "5m"})
    EXPECT_FALSE(read_number(text)) << '"' << text << '"';
}

TEST(NumberText, ACountHasDigitsAlone) {
  EXPECT_EQ(read_count("0"), 0u);
  EXPECT_EQ(read_count("010"), 10u) << "not octal";
  EXPECT_EQ(read_count("18446744073709551615"), 18446744073709551615u);
  for (const char* text :
       {"", " ", "+1", "-1", " 1", "1 ", "1.0", "1e3", "0x10", "0b1", "18446744073709551616"})
    EXPECT_FALSE(read_count(text)) << '"' << text << '"';
}

}  // namespace
}  // namespace nightcity
