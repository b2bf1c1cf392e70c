// The combinations of settings that `nightview sweep` measures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/render/setting_table.h"

namespace nightcity::experiments {

/// The value of each swept setting as text, by the setting's name; "-" where it makes no
/// difference.
using SweepPoint = std::map<std::string, std::string>;

/// Returns the settings that `nightview sweep` takes lists of, in the order of the table's columns.
std::vector<render::Setting> list_swept_settings();

/// Returns every combination of the settings' values, the first setting slowest. `chosen` holds
/// comma-separated lists by setting name; settings without one take their defaults. Combinations
/// that differ only in a setting that does not apply come once. Throws UsageError on a value that a
/// setting does not take.
std::vector<SweepPoint> list_combinations(const std::map<std::string, std::string>& chosen);

/// Returns the settings of a point; those that are not swept are the ones of `base`.
render::RenderSettings to_settings(const SweepPoint& point,
                                   const render::RenderSettings& base = {});

}  // namespace nightcity::experiments
