#include "tools/lights/hours_words.h"

#include <algorithm>
#include <cstddef>

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr int minutes_of_hour = 60, minutes_of_day = 24 * minutes_of_hour;

bool is_figure(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

void skip_spaces(string_view& text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
}

bool take(string_view& text, string_view sign) {
  string_view rest = text;
  skip_spaces(rest);
  if (!rest.starts_with(sign)) return false;
  rest.remove_prefix(sign.size());
  text = rest;
  return true;
}

std::optional<int> take_word(string_view& text, std::initializer_list<string_view> words) {
  string_view rest = text;
  skip_spaces(rest);
  std::size_t size = 0;
  while (size < rest.size() && is_letter(rest[size])) ++size;
  const auto found = std::find(words.begin(), words.end(), rest.substr(0, size));
  if (size == 0 || found == words.end()) return {};
  text = rest.substr(size);
  return static_cast<int>(found - words.begin());
}

std::optional<int> take_digits(string_view& text, std::size_t most) {
  std::size_t size = 0;
  int value = 0;
  for (; size < text.size() && is_figure(text[size]); ++size)
    if (size < most) value = 10 * value + text[size] - '0';
  if (size == 0 || size > most) return {};
  text.remove_prefix(size);
  return value;
}

std::optional<int> take_day_of_month(string_view& text) {
  string_view rest = text;
  skip_spaces(rest);
  string_view clock = rest;
  if (take_clock(clock)) return {};
  const auto number = take_digits(rest, 2);
  if (!number || *number < 1 || *number > 31) return {};
  text = rest;
  return number;
}

std::optional<int> take_month(string_view& text) {
  return take_word(
      text, {"jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"});
}

std::optional<int> take_weekday(string_view& text) {
  for (const auto& words :
       {std::initializer_list<string_view>{"mo", "tu", "we", "th", "fr", "sa", "su", "ph", "sh"},
        {"mon", "tue", "wed", "thu", "fri", "sat", "sun"},
        {"monday", "tuesday", "wednesday", "thursday", "friday", "saturday", "sunday"},
        {"montag", "di", "mi", "do", "freitag", "samstag", "so"},
        {"", "dienstag", "mittwoch", "donnerstag", "", "", "sonntag"}})
    if (const auto number = take_word(text, words)) return number;
  return {};
}

std::string to_plain_hours(std::string text) {
  if (const std::size_t other = text.find("||"); other != text.npos) text.resize(other);
  for (std::size_t from = 0; (from = text.find('"', from)) != text.npos;) {
    const std::size_t to = text.find('"', from + 1);
    if (to == text.npos) break;
    text.erase(from, to - from + 1);
  }
  for (const string_view word : {"daily", "every day", "t\xc3\xa4glich"})
    if (text.starts_with(word)) text.erase(0, word.size());
  for (const string_view word : {" to ", " till ", " until ", " bis "})
    for (std::size_t at; (at = text.find(word)) != text.npos;) text.replace(at, word.size(), "-");
  for (std::size_t at; (at = text.find(" uhr")) != text.npos;) text.erase(at, 4);
  return text;
}

std::optional<int> take_clock(string_view& text) {
  string_view rest = text;
  if (const auto word = take_word(rest, {"noon", "midnight"})) {
    text = rest;
    return *word == 0 ? 12 * minutes_of_hour : minutes_of_day;
  }
  skip_spaces(rest);
  auto hours = take_digits(rest, 2);
  std::optional<int> minutes;
  if (!hours) {  // "1800"
    const std::size_t before = rest.size();
    const auto both = take_digits(rest, 4);
    if (!both || before - rest.size() != 4) return {};
    hours = *both / 100;
    minutes = *both % 100;
  } else if (rest.starts_with(':') || rest.starts_with('.') || rest.starts_with('h')) {
    const bool has_word = rest.front() == 'h';
    string_view behind = rest.substr(1);
    const std::size_t before = behind.size();
    minutes = take_digits(behind, 2);
    if (minutes ? before - behind.size() != 2 : !has_word) return {};
    if (!minutes) minutes = 0;
    rest = behind;
  }
  if (const auto half = take_word(rest, {"am", "pm"})) {
    if (*hours < 1 || *hours > 12) return {};
    hours = *hours % 12 + (*half == 1 ? 12 : 0);
  } else if (!minutes) {
    return {};  // a number alone is no clock
  }
  if (minutes.value_or(0) > 59 || *hours > 48) return {};
  text = rest;
  return *hours * minutes_of_hour + minutes.value_or(0);
}

}  // namespace nightcity::lights
