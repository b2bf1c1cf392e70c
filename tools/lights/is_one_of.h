// Looks a word up in a list of words.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace nightcity::lights {

template <std::size_t N>
bool is_one_of(const std::string& word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace nightcity::lights
