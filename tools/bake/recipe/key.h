// The keys of a recipe: how each is written, what it means and where its value goes. The reader,
// `nightbake recipe` and docs/recipe.md are all made from the same keys.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/bake/recipe/value.h"
#include "tools/inputs/named_once.h"

namespace nightcity::recipe {

struct Key {
  std::string name;           // "tile_m"
  std::string type;           // "number", "list of paths"
  std::string default_value;  // as written in TOML; "": none, and `help` says what happens then
  std::string unit;           // "m"; "": none
  std::string range;          // "10 to 10000"; "": every value of the type
  std::string example;        // the value as written in TOML; "": the default
  std::string help;           // one or more sentences
  std::function<void(const Value&)> read;  // checks a value and stores it
};

struct Table {
  std::string name;  // "city"
  std::string help;
  std::vector<Key> keys;
  std::function<void()> on_present{};  // called when the recipe has the table, before its keys
};

struct Limits {
  double min, max;
};

// Each function below returns a key that stores what it reads in `target`. The default in the
// reference is the value that `target` has at the time of the call. `help` is Markdown.

Key number_key(std::string name, double& target, Limits limits, std::string unit, std::string help);

/// Without a default: `target` stays empty where the recipe is silent.
Key number_key(std::string name, std::optional<double>& target, Limits limits, std::string unit,
               std::string example, std::string help);

Key flag_key(std::string name, bool& target, std::string help);
Key text_key(std::string name, std::string& target, std::string example, std::string help);
Key texts_key(std::string name, std::vector<std::string>& target, std::string example,
              std::string help);

struct PathList {
  /// Returns the files that a folder stands for, and any other path as it is; null: folders stand
  /// for themselves.
  std::vector<std::filesystem::path> (*expand)(const std::filesystem::path&) = nullptr;
  inputs::Mention kept = inputs::Mention::first;  // of a file that is named again
};

/// Names are relative to `folder`. A file that is named again is in `target` once, and a note on
/// stderr counts how often.
Key paths_key(std::string name, std::vector<std::filesystem::path>& target,
              const std::filesystem::path& folder, PathList list, std::string example,
              std::string help);

template <class Integer>
Key integer_key(std::string name, Integer& target, int min, int max, std::string help) {
  const std::string range = max == std::numeric_limits<int>::max()
                                ? "from " + std::to_string(min)
                                : std::to_string(min) + " to " + std::to_string(max);
  return {std::move(name),
          "integer",
          std::to_string(target),
          "",
          range,
          "",
          std::move(help),
          [&target, min, max](const Value& value) {
            target = static_cast<Integer>(value.integer(min, max));
          }};
}

template <class Choice>
using Choices = std::vector<std::pair<std::string, Choice>>;

/// Returns the choice that `value` names. Refuses every other text.
template <class Choice>
Choice to_choice(const Value& value, const Choices<Choice>& choices) {
  const std::string text = value.text();
  std::string names;
  for (const auto& [name, choice] : choices) {
    if (text == name) return choice;
    names += (names.empty() ? "\"" : ", \"") + name + "\"";
  }
  value.refuse("is none of " + names);
}

/// A string out of `choices`. `Target` is the choice's type or a std::optional of it.
template <class Choice, class Target>
Key choice_key(std::string name, Target& target, const Choices<Choice>& choices, std::string help) {
  std::string default_value, range;
  for (const auto& [text, choice] : choices) {
    if (target == choice) default_value = "\"" + text + "\"";
    range += (range.empty() ? "\"" : ", \"") + text + "\"";
  }
  return {std::move(name),
          "string",
          default_value,
          "",
          range,
          "\"" + choices.front().first + "\"",
          std::move(help),
          [&target, choices](const Value& value) { target = to_choice(value, choices); }};
}

/// Reads the keys of `settings` into their targets. `prefix` begins names in messages: "[city] ".
/// Throws UsageError with the nearest known key where a key is unknown.
void read_keys(const std::string& file, const std::string& prefix, const toml::table& settings,
               const std::vector<Key>& keys);

}  // namespace nightcity::recipe
