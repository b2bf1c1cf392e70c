#include "runtime/viewer/window_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/error.h"
#include "runtime/render/parse.h"
#include "runtime/render/setting_table.h"
#include "runtime/viewer/config_folder.h"
#include "runtime/viewer/views.h"

namespace nightcity::viewer {
namespace {

constexpr const char* curves[] = {"linear", "reinhard", "filmic"};

}  // namespace

std::vector<render::NamedText> list_window_values(const ViewerState& state) {
  const render::RenderSettings& settings = state.settings;
  // Pictures that are looked at have bounces; every command has a default of its own for them, and
  // for the sky.
  render::RenderSettings defaults;
  std::vector<render::NamedText> values = list_changes(settings, defaults);
  const auto add = [&](const char* name, const std::string& text) {
    values.push_back({name, text});
  };
  for (const char* name : {"bounces", "sky"})
    if (std::none_of(values.begin(), values.end(),
                     [&](const render::NamedText& value) { return value.name == name; }))
      add(name, render::text_of(*render::find_setting(name), settings));
  add("time", render::time_text(settings.time_s));
  if (settings.environment.lights != scene::all_families)
    add("lights", scene::text_of(settings.environment.lights));
  add("ev", state.auto_exposure ? "auto" : fmt::format("{:.2f}", settings.display.ev100));
  add("tone", curves[std::min<std::uint32_t>(settings.display.tone, 2)]);
  return values;
}

void write_settings(const std::filesystem::path& file, const ViewerState& state) {
  const render::RenderSettings& settings = state.settings;
  render::SettingsFile written{file, list_window_values(state), {}};
  std::string view =
      list_views()[std::min<std::size_t>(settings.display.view, VIEW_COUNT - 1)].name;
  std::replace(view.begin(), view.end(), ' ', '-');
  written.window = {{"show", view}, {"every", std::to_string(state.divisor)}};
  write_settings_file(written, "Written by the window of nightview (Ctrl+S).");
}

std::string save_settings(std::filesystem::path file, const ViewerState& state) {
  if (file.empty()) {
    const std::filesystem::path folder = find_config_folder();
    if (folder.empty())
      throw Error("settings", "there is no home folder: --settings FILE names a file for them");
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    file = folder / "settings.toml";
  }
  write_settings(file, state);
  return fmt::format("settings saved: --settings {} takes them, in every command", file.string());
}

int parse_divisor(const std::string& text) {
  const auto divisor = static_cast<int>(render::parse_count("--every", text, 0, 8));
  if (divisor != 0 && (divisor & (divisor - 1)) != 0)
    throw UsageError("--every", "'" + text + "' is not 0, 1, 2, 4 or 8");
  return divisor;
}

std::string find_window_value(const render::SettingsFile& file, const char* name) {
  const auto found = std::find_if(file.window.begin(), file.window.end(),
                                  [&](const auto& value) { return value.name == name; });
  return found == file.window.end() ? "" : found->text;
}

}  // namespace nightcity::viewer
