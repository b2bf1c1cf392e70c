// The window's settings in a settings file (render/settings_file.h).
#pragma once

#include <filesystem>

#include "runtime/render/settings_file.h"
#include "runtime/viewer/panel.h"

namespace nightcity::viewer {

/// Returns what of the window's state every command takes as options: the settings that differ from
/// the defaults, bounces and sky in any case, time, lights and exposure.
std::vector<render::NamedText> list_window_values(const ViewerState& state);

/// Writes what differs from the defaults: to [render] what every command takes, to [window] the
/// rest. Throws Error.
void write_settings(const std::filesystem::path& file, const ViewerState& state);

/// The same to settings.toml in the user's folder, where `file` is "". Returns the sentence that
/// says where. Throws Error.
std::string save_settings(std::filesystem::path file, const ViewerState& state);

/// Returns the divisor (Refinement::set_divisor) of a word: 0, 1, 2, 4 or 8. Throws UsageError.
int parse_divisor(const std::string& text);

/// Returns the value of a key of [window], "" where it has none.
std::string find_window_value(const render::SettingsFile& file, const char* name);

}  // namespace nightcity::viewer
