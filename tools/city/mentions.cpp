#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/find_name.h"

namespace nightcity::city {

bool mentions(const Document& document, std::string_view text) {
  constexpr std::size_t first_block = std::size_t{1} << 15;
  constexpr std::size_t max_block = std::size_t{1} << 19;  // stays in the second cache
  const auto source = document.open();
  // Blocks begin at one place, a little behind the beginning of the window: some processors copy a
  // page slowly to a few bytes behind the beginning of another.
  const std::size_t begin = std::max(text.size(), std::size_t{64});
  std::vector<char> window;
  std::size_t kept = 0;  // bytes before `begin`
  for (std::size_t block = first_block;; block = std::min(2 * block, max_block)) {
    window.resize(std::max(window.size(), begin + block));
    char* const read = window.data() + begin;
    const std::size_t got = source->read(read, block);
    if (got == 0) return false;
    if (find_name({read - kept, kept + got}, text) != std::string_view::npos) return true;
    if (std::memchr(read, 0, got)) return false;  // no text: its reader says so
    const std::size_t size = kept + got;
    kept = std::min(size, text.size() - 1);  // the text may lie across the border
    std::memmove(read - kept, read + got - kept, kept);
  }
}

}  // namespace nightcity::city
