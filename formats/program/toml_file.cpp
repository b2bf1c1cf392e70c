#include "formats/program/toml_file.h"

#include <fmt/format.h>

#include "formats/error.h"
#include "formats/program/nearest_word.h"
#include "formats/program/toml_depth.h"
#include "formats/small_file.h"

namespace nightcity::program {
namespace {

// Returns the first text that holds a zero byte; null without.
const toml::node* find_zero_byte(const toml::node& node) {
  const toml::node* found = nullptr;
  const auto look_at = [&found](const toml::node& inner) {
    if (!found) found = find_zero_byte(inner);
  };
  if (const auto* text = node.as_string())
    return text->get().find('\0') == std::string::npos ? nullptr : &node;
  if (const toml::array* array = node.as_array())
    for (const toml::node& element : *array) look_at(element);
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table) look_at(value);
  return found;
}

}  // namespace

toml::table read_toml(const std::filesystem::path& path) {
  const std::string text = read_small_file(path);
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw Error(path.string(), "is in UTF-16: TOML is in UTF-8, so save it as that");
  constexpr std::size_t max_key_parts = 32;
  if (const auto line = find_deep_key(text, max_key_parts))
    throw Error(path.string(), *line,
                "a key has more than " + std::to_string(max_key_parts) + " parts");
  try {
    toml::table document = toml::parse(text, path.string());
    // The name of a file would end there for the system, and a message for the reader.
    if (const toml::node* node = find_zero_byte(document))
      throw Error(path.string(), node->source().begin.line, "a text holds a zero byte");
    return document;
  } catch (const toml::parse_error& error) {
    std::string why(error.description());
    if (why.find("escape sequence") != why.npos)
      why +=
          " (of a path, / lies between folders; in 'single quotes' \\ is a character like others)";
    throw Error(path.string(), error.source().begin.line, "is not TOML: " + why);
  }
}

std::string quote_for_toml(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

void refuse_unknown_key(const std::string& file, const toml::key& key, const std::string& what,
                        const std::vector<std::string>& known) {
  std::string message = "unknown " + what;
  const std::string nearest = find_nearest_word(std::string(key.str()), known);
  if (!nearest.empty()) message += "; did you mean \"" + nearest + "\"?";
  throw UsageError(file, key.source().begin.line, message);
}

}  // namespace nightcity::program
