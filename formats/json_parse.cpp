#include "formats/json_parse.h"

#include <simdjson.h>

#include <optional>
#include <utility>

#include "formats/error.h"

namespace nightcity {
namespace {

using nlohmann::json;
using Element = simdjson::dom::element;

// Its depth is bounded by the parser's. As with nlohmann-json, the last of members of one name
// holds.
json convert(const Element& element) {
  switch (element.type()) {
    case simdjson::dom::element_type::ARRAY: {
      const simdjson::dom::array elements = element.get_array().value_unsafe();
      json array = json::array();
      array.get_ref<json::array_t&>().reserve(elements.size());
      for (const Element e : elements) array.push_back(convert(e));
      return array;
    }
    case simdjson::dom::element_type::OBJECT: {
      const simdjson::dom::object members = element.get_object().value_unsafe();
      json object = json::object();
      auto& to = object.get_ref<json::object_t&>();
      for (const auto& [key, value] : members)
        to.insert_or_assign(to.end(), std::string(key), convert(value));
      return object;
    }
    case simdjson::dom::element_type::INT64: {
      const std::int64_t number = element.get_int64().value_unsafe();
      return number < 0 ? json(number) : json(static_cast<std::uint64_t>(number));
    }
    case simdjson::dom::element_type::UINT64:
      return element.get_uint64().value_unsafe();
    case simdjson::dom::element_type::DOUBLE:
      return element.get_double().value_unsafe();
    case simdjson::dom::element_type::STRING:
      return std::string(element.get_string().value_unsafe());
    case simdjson::dom::element_type::BOOL:
      return element.get_bool().value_unsafe();
    case simdjson::dom::element_type::NULL_VALUE:
      break;
  }
  return nullptr;
}

// Returns the document, or nothing where the text is no JSON or this parser has no room for it: the
// slower parser, which then says what is wrong, has the last word.
std::optional<json> parse_fast(std::string_view text) {
  simdjson::dom::parser parser;
  Element root;
  if (parser.allocate(text.size(), max_json_depth) != simdjson::SUCCESS ||
      parser.parse(text.data(), text.size()).get(root) != simdjson::SUCCESS)
    return std::nullopt;
  return convert(root);
}

// Returns whether brackets outside of strings open deeper than allowed.
bool is_too_deep(std::string_view text) {
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"':
        for (++i; i < text.size() && text[i] != '"'; ++i)
          if (text[i] == '\\') ++i;
        break;
      case '[':
      case '{':
        if (++depth > max_json_depth) return true;
        break;
      case ']':
      case '}':
        if (depth > 0) --depth;
        break;
      default:
        break;
    }
  }
  return false;
}

}  // namespace

json parse_json(std::string_view text, const std::string& name) {
  if (std::optional<json> document = parse_fast(text)) return std::move(*document);
  if (is_too_deep(text))
    throw Error(name, "nests arrays and objects deeper than " + std::to_string(max_json_depth));
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw Error(name, "is no JSON: " + describe(error));
  }
}

std::string describe(const json::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return text.starts_with("[json.exception.") && end != std::string::npos ? text.substr(end + 2)
                                                                          : text;
}

json try_parse_json(std::string_view text) {
  if (std::optional<json> document = parse_fast(text)) return std::move(*document);
  return is_too_deep(text) ? json(json::value_t::discarded) : json::parse(text, nullptr, false);
}

}  // namespace nightcity
