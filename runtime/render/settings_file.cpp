#include "runtime/render/settings_file.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/program/toml_file.h"
#include "runtime/measure/exposure.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/parse.h"
#include "runtime/render/presets.h"
#include "runtime/render/setting_table.h"
#include "runtime/scene/light_families.h"

namespace nightcity::render {
namespace {

// An option of more than one command that is no render setting. `check` throws UsageError for a
// text that the option does not take.
struct OtherKey {
  const char* name;
  void (*check)(const std::string& text);
};

constexpr OtherKey other_keys[] = {
    {"size", [](const std::string& text) { parse_size(text); }},
    {"time", [](const std::string& text) { parse_time(text); }},
    {"camera", [](const std::string&) {}},
    {"sky-map", [](const std::string&) {}},
    {"moon", [](const std::string& text) { parse_moon(text); }},
    {"lights", [](const std::string& text) { scene::parse_families(text); }},
    {"preset",
     [](const std::string& text) { read_preset("gpu", text); }},  // all classes have the same names
    {"ev", [](const std::string& text) { parse_exposure(text); }},
    {"tone", [](const std::string& text) { measure::tone_curve_from_name(text); }},
    {"leave-out", [](const std::string& text) { LeftOut parts(text); }},
};

std::string to_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

// Returns the text of a list's elements, separated by commas, or nothing where it is no such list:
// an element that is empty or holds a comma would come back as others.
std::optional<std::string> join(const toml::array& list) {
  std::string text;
  for (const toml::node& element : list) {
    const auto word = element.value_exact<std::string>();
    if (!word || word->empty() || word->find(',') != std::string::npos) return {};
    text += (text.empty() ? "" : ",") + *word;
  }
  return text;
}

std::optional<std::string> to_text(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return text;
  if (const auto flag = node.value_exact<bool>()) return *flag ? "yes" : "no";
  if (const auto whole = node.value_exact<std::int64_t>()) return std::to_string(*whole);
  if (const auto number = node.value_exact<double>()) return to_text(*number);
  if (const toml::array* list = node.as_array()) return join(*list);
  return {};
}

std::vector<NamedText> read_table(const std::string& file, const std::string& name,
                                  const toml::table& table) {
  std::vector<NamedText> values;
  for (const auto& [key, node] : table) {
    const std::size_t line = key.source().begin.line;
    const std::optional<std::string> text = to_text(node);
    if (!text)
      throw UsageError(file, line,
                       "[" + name + "] " + std::string(key.str()) +
                           " is no number, string, true, false or list of words without commas");
    values.push_back({std::string(key.str()), *text, line});
  }
  // The lines' order, in which a reader corrects them.
  std::sort(values.begin(), values.end(),
            [](const NamedText& a, const NamedText& b) { return a.line < b.line; });
  return values;
}

void check_render_keys(const std::string& file, const toml::table& table) {
  const std::vector<std::string>& known = list_render_keys();
  for (const auto& [key, node] : table)
    if (std::find(known.begin(), known.end(), key.str()) == known.end())
      program::refuse_unknown_key(file, key, "key [render] " + std::string(key.str()), known);
}

// Throws UsageError with file and line for a value that its option does not take.
void check_values(const SettingsFile& file) {
  RenderSettings unused;
  for (const NamedText& value : file.render) {
    try {
      if (const Setting* setting = find_setting(value.name)) {
        set_from_text(*setting, unused, value.text);
      } else {
        for (const OtherKey& key : other_keys)
          if (value.name == key.name) key.check(value.text);
      }
    } catch (const Error& error) {
      throw UsageError(file.path.string(), value.line, error.what());
    }
  }
}

// Returns whether a number that is written so is read as the same text: "007" is none in TOML, and
// "1.0", which may be the name of a file, would come back as "1".
bool is_number(const std::string& text) {
  const auto is_read_as = [&](auto value, const auto& write) {
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    return error == std::errc() && end == last && write(value) == text;
  };
  return is_read_as(std::int64_t{}, [](std::int64_t value) { return std::to_string(value); }) ||
         (text.find_first_of(".e") != std::string::npos &&
          is_read_as(double{}, [](double value) { return to_text(value); }));
}

bool has_empty_word(const std::string& text) {
  return ("," + text + ",").find(",,") != std::string::npos;
}

std::string to_toml(const NamedText& value) {
  if (value.name == "leave-out" && !has_empty_word(value.text)) {
    std::string list;
    std::istringstream words(value.text);
    for (std::string word; std::getline(words, word, ',');)
      list += (list.empty() ? "" : ", ") + program::quote_for_toml(word);
    return "[" + list + "]";
  }
  if (value.text == "yes") return "true";
  if (value.text == "no") return "false";
  return is_number(value.text) ? value.text : program::quote_for_toml(value.text);
}

// Returns a key as TOML has it: the window's are anything, and need quotes where they are no words.
std::string to_key(const std::string& name) {
  const auto is_bare = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
           c == '-';
  };
  if (!name.empty() && std::all_of(name.begin(), name.end(), is_bare)) return name;
  return program::quote_for_toml(name);
}

std::string to_toml(const char* name, const std::vector<NamedText>& table) {
  if (table.empty()) return "";
  std::string text = std::string("\n[") + name + "]\n";
  for (const NamedText& value : table) text += to_key(value.name) + " = " + to_toml(value) + "\n";
  return text;
}

}  // namespace

const NamedText* SettingsFile::find(const std::string& name) const {
  const auto found = std::find_if(render.begin(), render.end(),
                                  [&](const NamedText& value) { return value.name == name; });
  return found == render.end() ? nullptr : &*found;
}

const std::vector<std::string>& list_render_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const OtherKey& key : other_keys) all.push_back(key.name);
    for (const Setting& setting : list_settings()) {
      all.push_back(setting.name);
      all.insert(all.end(), setting.aliases.begin(), setting.aliases.end());
    }
    return all;
  }();
  return keys;
}

SettingsFile read_settings_file(const std::filesystem::path& path) {
  const std::string file = path.string();
  const toml::table document = program::read_toml(path);
  SettingsFile settings{path, {}, {}};
  for (const auto& [key, node] : document) {
    if (key != "render" && key != "window")
      program::refuse_unknown_key(file, key, "table [" + std::string(key.str()) + "]",
                                  {"render", "window"});
    const toml::table* table = node.as_table();
    if (!table)
      throw UsageError(file, key.source().begin.line, std::string(key.str()) + " is not a table");
    if (key == "render") {
      check_render_keys(file, *table);
      settings.render = read_table(file, "render", *table);
    } else {
      settings.window = read_table(file, "window", *table);
    }
  }
  check_values(settings);
  return settings;
}

void apply_settings_file(const SettingsFile& file, RenderSettings& settings,
                         const std::function<bool(const std::string& name)>& is_given) {
  for (const NamedText& entry : file.render) {
    const Setting* setting = find_setting(entry.name);
    if (setting && !is_given(setting->name)) set_from_text(*setting, settings, entry.text);
  }
}

std::vector<NamedText> list_changes(const RenderSettings& settings,
                                    const RenderSettings& defaults) {
  std::vector<NamedText> changes;
  for (const Setting& setting : list_settings())
    if (const std::string text = text_of(setting, settings); text != text_of(setting, defaults))
      changes.push_back({setting.name, text});
  return changes;
}

std::string describe_changes(const RenderSettings& settings) {
  std::vector<NamedText> changes = list_changes(settings, RenderSettings{});
  if (settings.projection != PROJECTION_PERSPECTIVE)
    changes.push_back({"projection", name_projection(settings.projection)});
  if (settings.environment.lights != scene::all_families)
    changes.push_back({"lights", scene::text_of(settings.environment.lights)});
  std::string text;
  for (const NamedText& change : changes)
    text += (text.empty() ? "" : " ") + change.name + "=" + change.text;
  return text;
}

void write_settings_file(const SettingsFile& file, const std::string& comment) {
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  text += to_toml("render", file.render) + to_toml("window", file.window);
  AtomicFile out(file.path);
  out.write(text);
  out.commit();
}

}  // namespace nightcity::render
