// Presets: settings from fast to accurate, taken from measured Pareto fronts, by class of device.
// The one table of them is preset_table.inc, which `nightview presets --from SWEEP.csv` makes anew.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/render/settings.h"

namespace nightcity::render {

/// The settings of a preset, as words that set_from_text takes. Settings that it does not name keep
/// their values.
struct Preset {
  const char* device_class;  // "cpu" or "gpu"
  const char* name;          // "fast", "balanced", "accurate", "reference"
  const char* settings;      // "estimator=traced candidates=8"
};

/// Returns the table. Every class has every name once, from fast to reference.
const std::vector<Preset>& list_presets();
/// Returns the names of a class, from fast to reference.
const std::vector<std::string>& list_preset_names();

/// Returns the class of a device by its kind (gpu::DeviceInfo::kind).
std::string find_device_class(const std::string& kind);

/// Returns name and word of each setting of a preset. Throws UsageError where there is no such
/// preset, with the names that there are.
std::vector<std::pair<std::string, std::string>> read_preset(const std::string& device_class,
                                                             const std::string& name);

/// Applies a preset to the settings but for those whose names `is_given` returns true for.
void apply_preset(const std::string& device_class, const std::string& name,
                  RenderSettings& settings,
                  const std::function<bool(const std::string& name)>& is_given);

}  // namespace nightcity::render
