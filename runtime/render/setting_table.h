// The one table of render settings: names, ranges, help, and where each applies. Command lines, the
// sweep, the viewer's panel and the renderer's own checks are made from it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/render/settings.h"

namespace nightcity::render {

enum class SettingGroup { sampling, reuse, indirect, environment, air, display };

/// The form in which the viewer's panel shows a setting.
struct SettingSlider {
  const char* label;
  double max;  // the useful part of the range
  const char* format;
  bool logarithmic = false;
};

/// A word that a setting of a number takes, too.
struct SettingWord {
  const char* word;
  void (*set)(RenderSettings& settings);
  bool (*is_set)(const RenderSettings& settings);
};

/// A setting. A new one is a member in settings.h and a row in
/// sampling_settings.cpp or light_settings.cpp.
struct Setting {
  using Value = std::variant<bool*, std::uint32_t*, float*, Estimator*>;

  const char* name;                       // of the option, without "--"
  std::vector<const char*> aliases = {};  // older names of the option
  // Column of sweep.csv where it is not the name: scripts read the file, so a column keeps its
  // first name.
  const char* column = nullptr;
  SettingGroup group;
  const char* unit = "";    // "" for shares, counts and flags
  double min = 0, max = 1;  // both included; not used by estimators
  std::string help;
  Value (*value)(RenderSettings& settings);
  std::vector<SettingWord> words = {};
  // Called before a number is set.
  void (*leave_words)(RenderSettings& settings) = [](RenderSettings&) {};
  // Returns whether the setting makes a difference with these settings.
  bool (*applies)(const RenderSettings& settings) = [](const RenderSettings&) { return true; };
  bool is_swept = false;  // `nightview sweep` takes a list of values
  std::string sweep_values =
      "";  // that list where the user gives none; "" = the setting's default alone
  std::optional<SettingSlider> slider = std::nullopt;
};

const std::vector<Setting>& list_settings();

/// Returns the setting of that name, or older name; null where there is none.
const Setting* find_setting(const std::string& name);

/// Returns the help text with the unit.
std::string describe(const Setting& setting);

/// Returns the name of the setting's column in sweep.csv.
std::string column_of(const Setting& setting);

/// Returns "--name", as messages call the setting.
std::string option_of(const Setting& setting);

/// Sets a setting from a word: a number, "yes" or "no", an estimator's name, or one of its words.
/// Throws UsageError when the word is none of its values.
void set_from_text(const Setting& setting, RenderSettings& settings, const std::string& word);

/// Returns the setting's value as set_from_text takes it.
std::string text_of(const Setting& setting, RenderSettings settings);

/// Returns the values that a sweep takes where the user gives none, comma-separated.
std::string default_list(const Setting& setting);

/// Throws UsageError when a number lies outside its range or is NaN, or the shares leave nothing to
/// lights that no grid cell lists.
void check_settings(const RenderSettings& settings);

}  // namespace nightcity::render
