// The values of a recipe, each with its name and line, for messages.
#pragma once

#include <toml++/toml.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "formats/error.h"

namespace nightcity::recipe {

struct Setting {
  const std::string& file;
  std::string name;  // "[city] tile_m"
  const toml::node& node;

  [[noreturn]] void refuse(const std::string& message) const {
    const auto line = node.source().begin.line;
    throw UsageError(file, line ? "line " + std::to_string(line) : "", name + " " + message);
  }
  double number(double least, double greatest) const {
    const auto value = node.value<double>();
    if (!value || !node.is_number()) refuse("is not a number");
    if (!(*value >= least && *value <= greatest))
      refuse("is not between " + short_number(least) + " and " + short_number(greatest));
    return *value;
  }
  int integer(int least, int greatest) const {
    if (!node.is_integer()) refuse("is not a whole number");
    return static_cast<int>(number(least, greatest));
  }
  bool boolean() const {
    const auto value = node.value_exact<bool>();
    if (!value) refuse("is not true or false");
    return *value;
  }
  std::string text() const {
    const auto value = node.value_exact<std::string>();
    if (!value) refuse("is not a string");
    return *value;
  }
  std::vector<std::string> texts() const {
    if (node.is_string()) return {text()};
    const toml::array* array = node.as_array();
    if (!array) refuse("is not a list of strings");
    std::vector<std::string> result;
    for (const toml::node& element : *array) result.push_back(Setting{file, name, element}.text());
    return result;
  }

 private:
  static std::string short_number(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }
};

/// What to do with the value of a key, and the keys of a table.
using Handler = std::function<void(const Setting&)>;
using Table = std::map<std::string, Handler>;

}  // namespace nightcity::recipe
