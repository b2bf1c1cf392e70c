#include "formats/program/nearest_word.h"

#include <algorithm>

namespace nightcity::program {
namespace {

std::size_t count_edits(const std::string& a, const std::string& b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> d((a.size() + 1) * width);
  for (std::size_t i = 0; i <= a.size(); ++i) d[i * width] = i;
  for (std::size_t j = 0; j < width; ++j) d[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j < width; ++j) {
      const std::size_t replaced = d[(i - 1) * width + j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0);
      d[i * width + j] = std::min({d[(i - 1) * width + j] + 1, d[i * width + j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i * width + j] = std::min(d[i * width + j], d[(i - 2) * width + j - 2] + 1);
    }
  return d.back();
}

}  // namespace

std::string find_nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t limit = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const std::string& candidate : candidates)
    if (const std::size_t edits = count_edits(word, candidate); edits < limit) {
      limit = edits;
      nearest = candidate;
    }
  return nearest;
}

}  // namespace nightcity::program
