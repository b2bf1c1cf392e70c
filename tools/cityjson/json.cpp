#include "tools/cityjson/json.h"

#include <array>
#include <charconv>

namespace nightcity::cityjson {
namespace {

// Returns the length of what stands at `at` for no number; 0: none does.
std::size_t measure_no_number(std::string_view text, std::size_t at) {
  constexpr std::array<std::string_view, 5> words{"NaN", "nan(ind)", "nan", "Infinity", "inf"};
  const std::size_t sign = text[at] == '-';
  for (const std::string_view word : words)
    if (text.substr(at + sign).starts_with(word)) return sign + word.size();
  return 0;
}

// Puts an empty text, and blanks, in the place of each. Returns whether there was any.
bool blank_out_no_numbers(std::string& text) {
  bool found = false, in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') in_text = !in_text;
    if (in_text) {
      i += text[i] == '\\';  // what is escaped ends no text
    } else if (const std::size_t length = measure_no_number(text, i); length > 0) {
      text.replace(i, length, length, ' ');
      text[i] = text[i + 1] = '"';
      i += length - 1;
      found = true;
    }
  }
  return found;
}

}  // namespace

simdjson::error_code parse_text(dom::parser& parser, std::string_view text, dom::element& value) {
  const auto error = parser.parse(text.data(), text.size(), false).get(value);
  if (!error) return error;
  std::string copy(text);
  if (!blank_out_no_numbers(copy)) return error;
  copy.resize(text.size() + simdjson::SIMDJSON_PADDING, ' ');
  return parser.parse(copy.data(), text.size(), false).get(value);
}

std::optional<dom::element> find_member(const dom::object& object, std::string_view key) {
  dom::element value;
  if (object.at_key(key).get(value) != simdjson::SUCCESS || value.is_null()) return {};
  return value;
}

std::optional<dom::object> find_object(const dom::object& object, std::string_view key) {
  dom::object value;
  if (object.at_key(key).get(value) != simdjson::SUCCESS) return {};
  return value;
}

std::optional<dom::array> find_array(const dom::object& object, std::string_view key) {
  dom::array value;
  if (object.at_key(key).get(value) != simdjson::SUCCESS) return {};
  return value;
}

std::string_view find_text(const dom::object& object, std::string_view key) {
  std::string_view value;
  if (object.at_key(key).get(value) != simdjson::SUCCESS) return {};
  return value;
}

std::optional<glm::dvec3> to_vector(const dom::element& value) {
  dom::array numbers;
  if (value.get(numbers) != simdjson::SUCCESS) return {};
  if (numbers.size() != 3) return {};
  glm::dvec3 vector{0};
  glm::length_t i = 0;
  for (const dom::element& number : numbers) {
    const auto component = to_number(number);
    if (!component) return {};
    vector[i++] = *component;
  }
  return vector;
}

std::string to_text(const dom::element& value) {
  if (std::string_view text; value.get(text) == simdjson::SUCCESS) return std::string(text);
  if (std::int64_t whole = 0; value.get(whole) == simdjson::SUCCESS) return std::to_string(whole);
  const auto number = to_number(value);
  if (!number) return {};
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), *number).ptr;
  return {digits.data(), end};
}

}  // namespace nightcity::cityjson
