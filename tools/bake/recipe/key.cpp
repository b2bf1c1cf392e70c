#include "tools/bake/recipe/key.h"

#include <algorithm>
#include <utility>

#include "formats/error.h"
#include "formats/program/toml_file.h"

namespace nightcity::recipe {
namespace {

namespace fs = std::filesystem;

std::string to_range(const Limits& limits) {
  return to_short_text(limits.min) + " to " + to_short_text(limits.max);
}

// A folder that is named again is not searched again. Other mentions of a file can be told only
// when folders are replaced by their files.
std::vector<fs::path> read_paths(const Value& value, const fs::path& folder, const PathList& list) {
  inputs::NamedOnce once = inputs::name_once(value.paths(folder), list.kept);
  if (list.expand) {
    std::vector<fs::path> found;
    for (const fs::path& path : once.files) {
      const std::vector<fs::path> files = list.expand(path);
      found.insert(found.end(), files.begin(), files.end());
    }
    inputs::NamedOnce expanded = inputs::name_once(std::move(found), list.kept);
    expanded.repeats += once.repeats;
    if (once.repeats > 0) expanded.first_repeat = once.first_repeat;
    once = std::move(expanded);
  }
  if (once.files.empty()) value.refuse("names no file");
  if (once.repeats > 0)
    value.note("names files again that it has named, " + std::to_string(once.repeats) +
               (once.repeats == 1 ? " time (" : " times (the first is ") +
               once.first_repeat.string() + "): each is read once");
  return std::move(once.files);
}

}  // namespace

Key number_key(std::string name, double& target, Limits limits, std::string unit,
               std::string help) {
  return {std::move(name),
          "number",
          to_short_text(target),
          std::move(unit),
          to_range(limits),
          "",
          std::move(help),
          [&target, limits](const Value& value) { target = value.number(limits.min, limits.max); }};
}

Key number_key(std::string name, std::optional<double>& target, Limits limits, std::string unit,
               std::string example, std::string help) {
  return {std::move(name),
          "number",
          "",
          std::move(unit),
          to_range(limits),
          std::move(example),
          std::move(help),
          [&target, limits](const Value& value) { target = value.number(limits.min, limits.max); }};
}

Key flag_key(std::string name, bool& target, std::string help) {
  return {std::move(name),
          "boolean",
          target ? "true" : "false",
          "",
          "",
          "",
          std::move(help),
          [&target](const Value& value) { target = value.boolean(); }};
}

Key text_key(std::string name, std::string& target, std::string example, std::string help) {
  return {std::move(name),
          "string",
          target.empty() ? "" : "\"" + target + "\"",
          "",
          "",
          std::move(example),
          std::move(help),
          [&target](const Value& value) { target = value.text(); }};
}

Key texts_key(std::string name, std::vector<std::string>& target, std::string example,
              std::string help) {
  return {std::move(name),
          "string or list of strings",
          "",
          "",
          "",
          std::move(example),
          std::move(help),
          [&target](const Value& value) { target = value.texts(); }};
}

Key paths_key(std::string name, std::vector<fs::path>& target, const fs::path& folder,
              PathList list, std::string example, std::string help) {
  return {
      std::move(name),
      "path or list of paths",
      "",
      "",
      "",
      std::move(example),
      std::move(help),
      [&target, folder, list](const Value& value) { target = read_paths(value, folder, list); }};
}

void read_keys(const std::string& file, const std::string& prefix, const toml::table& settings,
               const std::vector<Key>& keys) {
  for (const auto& [name, node] : settings) {
    const std::string_view own_name = name.str();  // clang 14 captures no structured binding
    const std::string full_name = prefix + std::string(own_name);
    const auto key = std::find_if(keys.begin(), keys.end(),
                                  [&](const Key& each) { return each.name == own_name; });
    if (key == keys.end()) {
      std::vector<std::string> known;
      for (const Key& each : keys) known.push_back(each.name);
      program::refuse_unknown_key(file, name, "key " + full_name, known);
    }
    key->read(Value{file, full_name, node});
  }
}

}  // namespace nightcity::recipe
