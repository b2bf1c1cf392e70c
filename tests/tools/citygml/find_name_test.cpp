#include "tools/city/find_name.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace nightcity::city {
namespace {

TEST(FindName, FindsWhatStringViewFinds) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> letter(0, 3), size(0, 40), from(0, 45);
  for (const char* name : {"aB", "B", "aa", "a", "BaB", "BBa", "abBa"})
    for (int i = 0; i < 5'000; ++i) {
      std::string text;
      for (int n = size(random); n > 0; --n) text += "aBb "[letter(random)];
      const auto start = static_cast<std::size_t>(from(random));
      EXPECT_EQ(find_name(text, name, start), std::string_view(text).find(name, start))
          << '"' << text << "\", " << name << ", " << start;
    }
}

}  // namespace
}  // namespace nightcity::city
