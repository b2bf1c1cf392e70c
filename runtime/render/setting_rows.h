// The rows of the table of settings are written with these names. For setting_table.cpp and the
// files of rows alone.
#pragma once

#include <vector>

#include "runtime/render/setting_table.h"

namespace nightcity::render::rows {

using Settings = RenderSettings;
using Group = SettingGroup;

/// Returns where a member of a group lies in the settings.
template <auto group, auto member>
Setting::Value at(Settings& s) {
  return &(s.*group.*member);
}

constexpr auto sampling = &Settings::sampling;
constexpr auto reuse = &Settings::reuse;
constexpr auto indirect = &Settings::indirect;
constexpr auto environment = &Settings::environment;
constexpr auto air = &Settings::air;
constexpr auto display = &Settings::display;

inline const EstimatorTraits& traits(const Settings& s) {
  return traits_of(s.sampling.estimator);
}

inline bool samples(const Settings& s) {
  return traits(s).samples;
}

std::vector<Setting> make_first_settings();
std::vector<Setting> make_reuse_settings();
std::vector<Setting> make_sampling_settings();
std::vector<Setting> make_indirect_settings();
std::vector<Setting> make_other_settings();
std::vector<Setting> make_air_settings();
/// Columns of sweeps keep their order: what is new comes last.
std::vector<Setting> make_last_settings();

}  // namespace nightcity::render::rows
