#include "runtime/render/presets.h"

#include <algorithm>
#include <sstream>

#include "formats/error.h"
#include "runtime/render/setting_table.h"

namespace nightcity::render {

const std::vector<Preset>& list_presets() {
  static const std::vector<Preset> presets{
#include "runtime/render/preset_table.inc"
  };
  return presets;
}

const std::vector<std::string>& list_preset_names() {
  static const std::vector<std::string> names{"fast", "balanced", "accurate", "reference"};
  return names;
}

std::string find_device_class(const std::string& kind) {
  return kind == "cpu" ? "cpu" : "gpu";
}

std::vector<std::pair<std::string, std::string>> read_preset(const std::string& device_class,
                                                             const std::string& name) {
  const auto& all = list_presets();
  const auto preset = std::find_if(all.begin(), all.end(), [&](const Preset& each) {
    return device_class == each.device_class && name == each.name;
  });
  if (preset == all.end()) {
    std::string names;
    for (const std::string& each : list_preset_names()) names += (names.empty() ? "" : ", ") + each;
    throw UsageError("--preset", "there is no preset '" + name + "' (there are " + names + ")");
  }
  std::vector<std::pair<std::string, std::string>> settings;
  std::istringstream words(preset->settings);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return settings;
}

void apply_preset(const std::string& device_class, const std::string& name,
                  RenderSettings& settings,
                  const std::function<bool(const std::string& name)>& is_given) {
  for (const auto& [setting_name, word] : read_preset(device_class, name))
    for (const Setting& setting : list_settings())
      if (setting_name == setting.name && !is_given(setting_name))
        set_from_text(setting, settings, word);
}

}  // namespace nightcity::render
