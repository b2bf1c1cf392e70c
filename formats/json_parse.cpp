#include "formats/json_parse.h"

#include "formats/error.h"

namespace nightcity {
namespace {

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

nlohmann::json parse_json(std::string_view text, const std::string& name) {
  if (is_too_deep(text))
    throw Error(name, "nests arrays and objects deeper than " + std::to_string(max_json_depth));
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw Error(name, "is no JSON: " + describe(error));
  }
}

std::string describe(const nlohmann::json::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return text.starts_with("[json.exception.") && end != std::string::npos ? text.substr(end + 2)
                                                                          : text;
}

nlohmann::json try_parse_json(std::string_view text) {
  return is_too_deep(text) ? nlohmann::json(nlohmann::json::value_t::discarded)
                           : nlohmann::json::parse(text, nullptr, false);
}

}  // namespace nightcity
