#include "tools/citygml/number_list.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {
namespace {

using namespace std::string_view_literals;

// In UTF-8: the blanks that do not break lines, and those that are as wide as a letter or less.
std::size_t measure_blank(std::string_view text) {
  if (text.starts_with("\xC2\xA0"sv)) return 2;
  if (text.starts_with("\xE2\x80"sv) && text.size() > 2) {
    const auto last = static_cast<unsigned char>(text[2]);
    if ((last >= 0x80 && last <= 0x8A) || last == 0xAF) return 3;
  }
  constexpr std::array<std::string_view, 2> others{"\xE3\x80\x80", "\xEF\xBB\xBF"};
  for (const std::string_view other : others)
    if (text.starts_with(other)) return other.size();
  return text.starts_with(';') ? 1 : 0;
}

std::string replace_blanks(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t blank = measure_blank(text);
    out += blank > 0 ? ' ' : text.front();
    text.remove_prefix(std::max<std::size_t>(blank, 1));
  }
  return out;
}

// The commas in the words between blanks.
struct Commas {
  std::size_t most = 0, least = static_cast<std::size_t>(-1);  // in one word
  bool ends_words = false;                                     // "1, 2, 3"
};

Commas count_commas(std::string_view text) {
  Commas commas;
  for (std::size_t at = 0; at < text.size();) {
    if (is_space(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && !is_space(text[end])) ++end;
    const std::string_view word = text.substr(at, end - at);
    const auto count = static_cast<std::size_t>(std::count(word.begin(), word.end(), ','));
    commas.most = std::max(commas.most, count);
    commas.least = std::min(commas.least, count);
    commas.ends_words = commas.ends_words || word.ends_with(',');
    at = end;
  }
  return commas;
}

}  // namespace

std::string mend_number_list(std::string_view text) {
  std::string list = replace_blanks(text);
  const Commas commas = count_commas(list);
  if (commas.most == 0) return list;
  const bool has_points = list.find('.') != list.npos;
  // Decimal commas stay: nothing tells them from a comma in a tuple of two.
  if (commas.most > 1 || commas.ends_words || (commas.least == 1 && has_points))
    std::replace(list.begin(), list.end(), ',', ' ');
  return list;
}

}  // namespace nightcity::citygml
