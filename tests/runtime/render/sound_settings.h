// Checks that hold for every settings file, broken or not: for the fuzz target and the test of its
// corpus.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include "formats/error.h"
#include "runtime/render/settings_file.h"
#include "support/temp_folder.h"

namespace nightcity::test {

/// Returns what is wrong with how the file is read; "" where it is sound, or refused with a reason.
inline std::string find_fault_of_settings(const std::filesystem::path& path) {
  using namespace render;
  const auto apply = [](const SettingsFile& file) {
    RenderSettings settings;
    apply_settings_file(file, settings, [](const std::string&) { return false; });
    return settings;
  };
  static const TempFolder folder;
  const std::filesystem::path copy = folder / "again.toml";
  try {
    const SettingsFile file = read_settings_file(path);
    const RenderSettings settings = apply(file);
    describe_changes(settings);
    // A file that is written of it means the same.
    SettingsFile written = file;
    written.path = copy;
    write_settings_file(written, "a comment\nof two lines");
    const SettingsFile again = read_settings_file(written.path);
    if (!list_changes(apply(again), settings).empty()) return "what is written";
    const auto is_same = [](const NamedText& a, const NamedText& b) {
      return a.name == b.name && a.text == b.text;
    };
    for (const auto table : {&SettingsFile::render, &SettingsFile::window})
      if (!std::equal((file.*table).begin(), (file.*table).end(), (again.*table).begin(),
                      (again.*table).end(), is_same))
        return "the keys and values that are written";
  } catch (const Error& error) {
    if (std::string(error.what()).empty()) return "an error without words";
    if (std::string(error.what()).starts_with(copy.string()))
      return "a file that is written and refused: " + std::string(error.what());
  }
  return "";
}

}  // namespace nightcity::test
