#include "runtime/render/setting_table.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <type_traits>

#include "formats/error.h"
#include "runtime/render/parse.h"
#include "runtime/render/setting_rows.h"

namespace nightcity::render {

const std::vector<Setting>& list_settings() {
  static const std::vector<Setting> settings = [] {
    std::vector<Setting> all;
    // In this order they are the columns of sweep.csv.
    for (const auto& part :
         {rows::make_first_settings(), rows::make_reuse_settings(), rows::make_sampling_settings(),
          rows::make_indirect_settings(), rows::make_other_settings(), rows::make_air_settings(),
          rows::make_last_settings()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return settings;
}

const Setting* find_setting(const std::string& name) {
  for (const Setting& setting : list_settings())
    if (name == setting.name || std::any_of(setting.aliases.begin(), setting.aliases.end(),
                                            [&](const char* alias) { return name == alias; }))
      return &setting;
  return nullptr;
}

std::string describe(const Setting& setting) {
  const std::string unit = setting.unit;
  return setting.help + (unit.empty() ? "" : " (" + unit + ")");
}

std::string column_of(const Setting& setting) {
  return setting.column ? setting.column : setting.name;
}

std::string option_of(const Setting& setting) {
  return std::string("--") + setting.name;
}

void set_from_text(const Setting& setting, RenderSettings& settings, const std::string& word) {
  const std::string option = option_of(setting);
  for (const SettingWord& known : setting.words)
    if (word == known.word) return known.set(settings);
  const Setting::Value value = setting.value(settings);
  if (const auto flag = std::get_if<bool*>(&value)) {
    **flag = parse_yes_or_no(option, word);
  } else if (const auto count = std::get_if<std::uint32_t*>(&value)) {
    **count = static_cast<std::uint32_t>(
        parse_count(option, word, std::size_t(setting.min), std::size_t(setting.max)));
  } else if (const auto number = std::get_if<float*>(&value)) {
    const auto parsed = static_cast<float>(parse_number(option, word, setting.min, setting.max));
    setting.leave_words(settings);
    **number = parsed;
  } else {
    *std::get<Estimator*>(value) = find_estimator(word);
  }
}

std::string text_of(const Setting& setting, RenderSettings settings) {
  for (const SettingWord& known : setting.words)
    if (known.is_set(settings)) return known.word;
  const auto to_text = [](auto* value) -> std::string {
    using Value = std::remove_pointer_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>) {
      return *value ? "yes" : "no";
    } else if constexpr (std::is_same_v<Value, Estimator>) {
      return name_of(*value);
    } else {
      char text[32];
      return {text, std::to_chars(text, text + sizeof text, *value).ptr};
    }
  };
  return std::visit(to_text, setting.value(settings));
}

std::string default_list(const Setting& setting) {
  return setting.sweep_values.empty() ? text_of(setting, {}) : setting.sweep_values;
}

void check_settings(const RenderSettings& settings) {
  RenderSettings copy = settings;
  for (const Setting& setting : list_settings()) {
    const auto is_in_range = [&](auto* value) {
      if constexpr (std::is_same_v<decltype(value), Estimator*>)
        return true;
      else  // written so that NaN fails
        return double(*value) >= setting.min && double(*value) <= setting.max;
    };
    if (!std::visit(is_in_range, setting.value(copy)))
      throw UsageError(option_of(setting), "must be from " + std::to_string(setting.min) + " to " +
                                               std::to_string(setting.max));
  }
  // A light that is never sampled is missing from the picture, and nothing in the picture shows it.
  if (!(settings.sampling.near_share + settings.sampling.far_share <= 0.999f))
    throw UsageError("--near-share",
                     "and --far-share may be 0.999 together: lights that no grid cell lists need a "
                     "share too");
}

}  // namespace nightcity::render
