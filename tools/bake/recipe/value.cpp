#include "tools/bake/recipe/value.h"

#include <fmt/core.h>

#include <cstdio>
#include <optional>

#include "formats/error.h"

namespace nightcity::recipe {

void Value::refuse(const std::string& message) const {
  throw UsageError(file, node.source().begin.line, name + " " + message);
}

void Value::note(const std::string& message) const {
  fmt::print(stderr, "note: {}:{}: {} {}\n", file, node.source().begin.line, name, message);
}

double Value::number(double min, double max) const {
  // A whole number of more digits than a double has is one nevertheless.
  const std::optional<double> value =
      node.is_integer() ? static_cast<double>(**node.as_integer()) : node.value<double>();
  if (!value || !node.is_number()) refuse("is not a number");
  if (!(*value >= min && *value <= max))
    refuse("is not between " + to_short_text(min) + " and " + to_short_text(max));
  return *value;
}

int Value::integer(int min, int max) const {
  if (!node.is_integer()) refuse("is not a whole number");
  return static_cast<int>(number(min, max));
}

bool Value::boolean() const {
  const auto value = node.value_exact<bool>();
  if (!value) refuse("is not true or false");
  return *value;
}

std::string Value::text() const {
  const auto value = node.value_exact<std::string>();
  if (!value) refuse("is not a string");
  return *value;
}

std::filesystem::path Value::path(const std::filesystem::path& folder) const {
  const std::string name = text();
  if (name.empty()) refuse("holds an empty name");
  if (name.find("://") != name.npos)
    refuse("names an address of the web, " + name + ": fetch the file, and name it where it lies");
  if (name.starts_with("~/"))
    refuse("begins with ~, which stands for no folder here: write " + name + " as a whole path");
  const std::filesystem::path path = (folder / name).lexically_normal();
  std::error_code ignored;
  if (name.find('\\') != name.npos && !std::filesystem::exists(path, ignored))
    refuse("names " + name + ", which is not there: / lies between folders, and not \\");
  return path;
}

std::vector<std::filesystem::path> Value::paths(const std::filesystem::path& folder) const {
  if (node.is_string()) return {path(folder)};
  std::vector<std::filesystem::path> result;
  for (const Value& element : elements(0, "a list of strings"))
    result.push_back(element.path(folder));
  return result;
}

std::vector<std::string> Value::texts() const {
  if (node.is_string()) return {text()};
  std::vector<std::string> result;
  for (const Value& element : elements(0, "a list of strings")) result.push_back(element.text());
  return result;
}

std::vector<Value> Value::elements(std::size_t count, const std::string& what) const {
  const toml::array* array = node.as_array();
  if (!array || (count > 0 && array->size() != count)) refuse("is not " + what);
  std::vector<Value> result;
  for (const toml::node& element : *array) result.push_back({file, name, element});
  return result;
}

std::vector<std::pair<std::string, Value>> Value::rows(const std::string& what) const {
  const toml::table* table = node.as_table();
  if (!table) refuse("is not " + what);
  std::vector<std::pair<std::string, Value>> result;
  for (const auto& [key, row] : *table) {
    const std::string row_name(key.str());
    result.emplace_back(row_name, Value{file, name + "." + row_name, row});
  }
  return result;
}

std::string to_short_text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace nightcity::recipe
