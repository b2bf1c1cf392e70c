#include "tools/cityjson/json.h"

#include <array>
#include <charconv>

namespace nightcity::cityjson {

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
