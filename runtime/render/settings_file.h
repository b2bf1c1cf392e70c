// Settings files: TOML that says how pictures are made, read and written by every command that
// renders and by the window.
//
//     [render]
//     estimator = "traced"
//     candidates = 16
//     bounces = 2
//     leave-out = ["schedules", "aim"]
//
// The keys of [render] are the names of options, without dashes. A command passes over keys of
// options that it lacks. [window] belongs to the window alone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "runtime/render/settings.h"

namespace nightcity::render {

/// A value as the option of this name takes it on a command line.
struct NamedText {
  std::string name, text;
  std::size_t line = 0;  // in the file that it was read from
};

struct SettingsFile {
  std::filesystem::path path;
  std::vector<NamedText> render, window;

  /// Returns the value of a key of [render], or nullptr.
  const NamedText* find(const std::string& name) const;
};

/// Returns the keys of [render]: every render setting with its older names, and the options beside
/// them that say what is rendered.
const std::vector<std::string>& list_render_keys();

/// Reads a settings file. Throws Error with file and line where it is not TOML, and UsageError
/// where it has an unknown table, an unknown key in [render] or a value there that its option does
/// not take. Values of [window] are numbers, strings, truth values or lists of strings without
/// commas.
SettingsFile read_settings_file(const std::filesystem::path& path);

/// Sets every render setting that the file names, except those for which `is_given` returns true:
/// a command line has already set them.
void apply_settings_file(const SettingsFile& file, RenderSettings& settings,
                         const std::function<bool(const std::string& name)>& is_given);

/// Returns the settings that differ from `defaults`, as a settings file holds them.
std::vector<NamedText> list_changes(const RenderSettings& settings, const RenderSettings& defaults);

/// Returns what differs from the defaults in words, as metadata of a picture: "name=value ...",
/// with the projection and the kinds of light that are on.
std::string describe_changes(const RenderSettings& settings);

/// Writes a settings file; `comment` becomes the comment lines at its beginning. Throws Error.
void write_settings_file(const SettingsFile& file, const std::string& comment);

}  // namespace nightcity::render
