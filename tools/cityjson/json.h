// Values of JSON as simdjson gives them, checked where they are used: nothing here throws.
#pragma once

#include <simdjson.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace nightcity::cityjson {

namespace dom = simdjson::dom;

/// Parses a text behind which SIMDJSON_PADDING bytes may be read. NaN and Infinity, which are no
/// JSON but which Python and C++ write, are empty texts, as if nothing were said.
simdjson::error_code parse_text(dom::parser& parser, std::string_view text, dom::element& value);

/// Returns the member of an object; none where the object has no such member or it is null.
std::optional<dom::element> find_member(const dom::object& object, std::string_view key);
std::optional<dom::object> find_object(const dom::object& object, std::string_view key);
std::optional<dom::array> find_array(const dom::object& object, std::string_view key);
/// Returns "" where the member is no text. It lives as long as the document.
std::string_view find_text(const dom::object& object, std::string_view key);

/// Returns the finite number that a value is, whole or not; none for other values.
inline std::optional<double> to_number(const dom::element& value) {
  std::int64_t whole = 0;  // as nearly all are
  if (value.get(whole) == simdjson::SUCCESS) return static_cast<double>(whole);
  double number = 0;
  if (value.get(number) != simdjson::SUCCESS || !std::isfinite(number)) return {};
  return number;
}
/// Returns the index that a value is; none for all others, negative ones too.
inline std::optional<std::size_t> to_index(const dom::element& value) {
  std::int64_t whole = 0;  // as nearly all are
  if (value.get(whole) == simdjson::SUCCESS)
    return whole < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(whole));
  std::uint64_t number = 0;
  if (value.get(number) != simdjson::SUCCESS) return {};
  return static_cast<std::size_t>(number);
}
/// Returns the three numbers of an array; none for any other value.
std::optional<glm::dvec3> to_vector(const dom::element& value);
/// Returns a text as it is, and a number written out; "" for other values.
std::string to_text(const dom::element& value);

}  // namespace nightcity::cityjson
