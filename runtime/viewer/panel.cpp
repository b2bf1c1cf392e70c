#include "runtime/viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "runtime/measure/exposure.h"
#include "runtime/render/presets.h"
#include "runtime/render/setting_table.h"
#include "runtime/viewer/metering.h"
#include "runtime/viewer/views.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity::viewer {
namespace {

// Typed values are bounded as dragged ones are.
constexpr ImGuiSliderFlags bounded = ImGuiSliderFlags_AlwaysClamp;

// Draws the slider of a setting, greyed where the setting makes no difference.
void draw_slider(const render::Setting& setting, render::RenderSettings& settings) {
  const render::SettingSlider& slider = *setting.slider;
  const ImGuiSliderFlags flags = bounded | (slider.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  ImGui::BeginDisabled(!setting.applies(settings));
  const render::Setting::Value value = setting.value(settings);
  if (const auto count = std::get_if<std::uint32_t*>(&value)) {
    const auto low = std::uint32_t(setting.min), high = std::uint32_t(slider.max);
    ImGui::SliderScalar(slider.label, ImGuiDataType_U32, *count, &low, &high, slider.format, flags);
  } else if (const auto number = std::get_if<float*>(&value)) {
    ImGui::SliderFloat(slider.label, *number, float(setting.min), float(slider.max), slider.format,
                       flags);
  }
  ImGui::EndDisabled();
}

void draw_sliders(render::SettingGroup group, render::RenderSettings& settings) {
  for (const render::Setting& setting : render::list_settings())
    if (setting.group == group && setting.slider) draw_slider(setting, settings);
}

void draw_estimators(render::RenderSettings& settings) {
  render::Estimator& current = settings.sampling.estimator;
  if (!ImGui::BeginCombo("estimator", render::name_of(current))) return;
  for (const render::EstimatorTraits& estimator : render::list_estimators()) {
    if (ImGui::Selectable(estimator.name, estimator.estimator == current))
      current = estimator.estimator;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", estimator.description);
  }
  ImGui::EndCombo();
}

void draw_sampling(ViewerState& state) {
  render::RenderSettings& settings = state.settings;
  draw_estimators(settings);
  draw_sliders(render::SettingGroup::sampling, settings);
  draw_sliders(render::SettingGroup::reuse, settings);
  draw_sliders(render::SettingGroup::indirect, settings);
  ImGui::Checkbox("accumulate", &state.accumulate);
  ImGui::SameLine();
  ImGui::Checkbox("denoise", &settings.display.denoise);
}

void draw_exposure(ViewerState& state) {
  ImGui::Checkbox("auto", &state.auto_exposure);
  ImGui::SameLine();
  if (ImGui::SliderFloat("EV100", &state.settings.display.ev100, min_ev100, max_ev100, "%.1f",
                         bounded))
    state.auto_exposure = false;
  int tone = static_cast<int>(state.settings.display.tone);
  if (ImGui::Combo("curve", &tone, "linear\0reinhard\0filmic\0"))
    state.settings.display.tone = static_cast<std::uint32_t>(tone);
  draw_sliders(render::SettingGroup::display, state.settings);
  ImGui::Checkbox("adapt the white", &state.settings.display.adapt_white);
  ImGui::SameLine();
  ImGui::Checkbox("mesopic colours", &state.settings.display.mesopic);
}

void draw_camera(ViewerState& state, PanelRequests& requests) {
  int mode = static_cast<int>(state.camera.motion);
  const char* names[] = {"orbit", "fly", "walk"};
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine();
    ImGui::RadioButton(names[i], &mode, i);
  }
  state.camera.motion = static_cast<Motion>(mode);
  bool first = true;
  for (const std::string& preset : scene::camera_presets()) {
    if (!first) ImGui::SameLine();
    first = false;
    if (ImGui::SmallButton(preset.c_str())) requests.camera_preset = preset;
  }
  if (state.camera.motion != Motion::fly) return;
  ImGui::SliderFloat("speed", &state.camera.speed_m_s, 0.5f, 500, "%.1f m/s",
                     bounded | ImGuiSliderFlags_Logarithmic);
  ImGui::Checkbox("faster above 20 m", &state.camera.speed_by_height);
}

// A key that puts the cursor in the box also sends its letter, a frame later.
void draw_place(ViewerState& state, PanelRequests& requests) {
  if (state.focus_place > 0) ImGui::GetIO().ClearInputCharacters();
  if (state.focus_place == 2) ImGui::SetKeyboardFocusHere();
  state.focus_place = std::max(0, state.focus_place - 1);
  if (ImGui::InputTextWithHint("go to", "52.516, 13.378, a street or an id", state.place.data(),
                               state.place.size(), ImGuiInputTextFlags_EnterReturnsTrue))
    requests.go_to = state.place.data();
}

void draw_presets(PanelRequests& requests) {
  if (!ImGui::BeginCombo("preset", "from fast to accurate")) return;
  for (const std::string& name : render::list_preset_names())
    if (ImGui::Selectable(name.c_str())) requests.preset = name;
  ImGui::EndCombo();
}

// A value counts once the hand lets go: each one is measured anew.
void draw_governor(ViewerState& state, const FrameStats& stats) {
  constexpr ImGuiSliderFlags flags = bounded | ImGuiSliderFlags_Logarithmic;
  ImGui::SliderFloat("budget", &state.budget_ms, 0, 1000,
                     state.budget_ms > 0 ? "%.1f ms a frame in motion" : "none", flags);
  if (ImGui::IsItemDeactivatedAfterEdit()) state.governor.budget_ms = double{state.budget_ms};
  ImGui::SliderFloat("noise", &state.target_error, 0, 1,
                     state.target_error > 0 ? "%.3f is small enough" : "none", flags);
  if (ImGui::IsItemDeactivatedAfterEdit()) state.governor.target_error = double{state.target_error};
  if (!stats.pace.empty()) ImGui::TextDisabled("%s", stats.pace.c_str());
}

void draw_resolution(ViewerState& state) {
  constexpr int divisors[] = {0, 1, 2, 4, 8};
  int index = static_cast<int>(std::find(std::begin(divisors), std::end(divisors), state.divisor) -
                               divisors);
  if (ImGui::Combo("pixels", &index, "coarse, then all\0every\0every 2nd\0every 4th\0every 8th\0"))
    state.divisor = divisors[index];
}

// Sky and moon. A moon that was not placed stands where it lights most streets: 35 degrees high, in
// the south.
void draw_sky(render::EnvironmentSettings& environment) {
  float sky = environment.sky_cd_m2.x,
        moon = tonemap::luminance_709(environment.moon_lux.r, environment.moon_lux.g,
                                      environment.moon_lux.b);
  const bool glows = environment.glow != render::SkyGlow::none;
  if (ImGui::SliderFloat("sky", &sky, 0, glows ? 10 : 1, glows ? "%.3f of its glow" : "%.4f cd/m2",
                         bounded | ImGuiSliderFlags_Logarithmic))
    environment.sky_cd_m2 = glm::vec3(sky);
  if (!ImGui::SliderFloat("moon", &moon, 0, 0.3f, "%.3f lx", bounded)) return;
  const glm::vec3 direction = environment.moon_direction;
  render::set_moon(environment, 160, 35, double(moon));
  if (direction != render::EnvironmentSettings{}.moon_direction)
    environment.moon_direction = direction;
}

void draw_families(scene::LightFamilies& on) {
  constexpr struct {
    LightFamily family;
    const char* label;
    bool begins_row = false;
  } boxes[] = {{LightFamily::lamp, "street lamps", true},
               {LightFamily::window, "windows"},
               {LightFamily::headlamp, "headlights", true},
               {LightFamily::tail_lamp, "tail lights"},
               {LightFamily::other, "others"}};
  for (const auto& box : boxes) {
    if (!box.begins_row) ImGui::SameLine();
    bool shines = scene::has_family(on, box.family);
    if (ImGui::Checkbox(box.label, &shines)) on ^= scene::to_set(box.family);
  }
}

// The clock runs from 17:00 to 07:00, which is 5 to 19 hours after noon.
void draw_night(ViewerState& state) {
  ImGui::BeginDisabled(!state.night_changes);
  int minutes = static_cast<int>(state.settings.time_s / 60);
  const std::string shown = clock_text(state.settings.time_s);
  if (ImGui::SliderInt("clock", &minutes, night_begin_s / 60, night_end_s / 60, shown.c_str(),
                       bounded))
    state.settings.time_s = minutes * 60.0;
  ImGui::Checkbox("run", &state.play);
  ImGui::SameLine();
  ImGui::SliderFloat("##speed", &state.clock_speed, 1, 3600, "%.0f times",
                     bounded | ImGuiSliderFlags_Logarithmic);
  ImGui::EndDisabled();
  draw_families(state.settings.environment.lights);
  draw_sky(state.settings.environment);
  draw_sliders(render::SettingGroup::environment, state.settings);
  draw_sliders(render::SettingGroup::air, state.settings);
}

void draw_views(ViewerState& state) {
  render::DisplaySettings& display = state.settings.display;
  const auto& views = list_views();
  const ViewKind& shown = views[std::min<std::size_t>(display.view, views.size() - 1)];
  if (ImGui::BeginCombo("show", shown.name)) {
    for (const ViewKind& view : views) {
      if (ImGui::Selectable(view.name, view.view == display.view)) show_view(view, display);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", view.help);
    }
    ImGui::EndCombo();
  }
  if (!shown.unit) return;
  const std::string format = std::string("%.3g ") + shown.unit;
  constexpr ImGuiSliderFlags flags = bounded | ImGuiSliderFlags_Logarithmic;
  ImGui::SliderFloat("from", &display.view_lowest, 1e-4f, 1e3f, format.c_str(), flags);
  ImGui::SliderFloat("to", &display.view_highest, 1e-3f, 1e5f, format.c_str(), flags);
  display.view_highest = std::max(display.view_highest, 2 * display.view_lowest);
}

void draw_sides(const ViewerState& state, PanelRequests& requests) {
  bool on = state.compare.on;
  if (ImGui::Checkbox("compare A | B", &on)) requests.compare = true;
  if (!on) return;
  ImGui::SameLine();
  int side = state.compare.changes_b ? 1 : 0;
  for (int i = 0; i < 2; ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(i == 0 ? "change A" : "B", &side, i) &&
        (side == 1) != state.compare.changes_b)
      requests.change_side = true;
  }
}

void draw_cities(const FrameStats& stats, PanelRequests& requests) {
  if (!ImGui::BeginCombo("city", stats.scene.c_str())) return;
  for (const std::string& city : stats.cities)
    if (ImGui::Selectable(city.c_str())) requests.open = city;
  ImGui::EndCombo();
}

void draw_scene(ViewerState& state, const FrameStats& stats, PanelRequests& requests) {
  if (stats.cities.size() > 1)
    draw_cities(stats, requests);
  else
    ImGui::Text("%s", stats.scene.c_str());
  ImGui::Text("%zu triangles, %zu lights", stats.triangles, stats.lights);
  ImGui::TextDisabled("%s, rays: %s", stats.device.c_str(), stats.trace.c_str());
  if (!stats.place.empty()) ImGui::TextUnformatted(stats.place.c_str());
  if (stats.has_light) return;
  ImGui::TextWrapped("This scene has no lights: no .lights file lies beside it.");
  if (!ImGui::SmallButton("light sky and moon")) return;
  state.settings.environment.sky_cd_m2 = glm::vec3(0.05f);
  render::set_moon(state.settings.environment, 160, 35, 0.25);
}

void draw_report(const FrameStats& stats) {
  ImGui::Text("%u x %u, frame %u, %.1f ms", stats.width, stats.height, stats.frames,
              stats.frame_ms);
  ImGui::Text("memory: %.0f MB of the device, %.0f MB in all", double(stats.device_bytes) / 1e6,
              double(stats.process_bytes) / 1e6);
  if (stats.times_ms.size() > 1) {
    const float most = *std::max_element(stats.times_ms.begin(), stats.times_ms.end());
    const std::string label = fmt::format("frames, up to {:.0f} ms", double(most));
    ImGui::PlotLines("##times", stats.times_ms.data(), static_cast<int>(stats.times_ms.size()), 0,
                     label.c_str(), 0, most, {0, 2.5f * ImGui::GetFontSize()});
  }
  if (stats.passes.empty() || !ImGui::TreeNode("passes", "GPU %.2f ms", gpu::sum_ms(stats.passes)))
    return;
  for (const gpu::Timer::Span& pass : stats.passes)
    ImGui::Text("%-15s %8.2f ms", pass.name.c_str(), pass.ms);
  ImGui::TreePop();
}

// Moves the current window so far that all of it can be seen, or its upper left corner where it is
// larger than the screen.
void keep_on_screen() {
  const ImVec2 screen = ImGui::GetIO().DisplaySize, size = ImGui::GetWindowSize(),
               at = ImGui::GetWindowPos();
  const ImVec2 kept{std::max(0.0f, std::min(at.x, screen.x - size.x)),
                    std::max(0.0f, std::min(at.y, screen.y - size.y))};
  if (kept.x != at.x || kept.y != at.y) ImGui::SetWindowPos(kept);
}

}  // namespace

PanelRequests draw_panel(ViewerState& state, const FrameStats& stats) {
  PanelRequests requests;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize(), caption = 2 * em;
  ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
  // As wide as it needs, and no higher than leaves the caption free: then it scrolls.
  ImGui::SetNextWindowSizeConstraints({0, 0}, {1e6f, std::max(4 * em, screen.y - caption - 10)});
  if (ImGui::Begin("nightview", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::PushItemWidth(16 * em);
    draw_scene(state, stats, requests);
    draw_report(stats);
    ImGui::Separator();
    draw_presets(requests);
    draw_governor(state, stats);
    draw_sampling(state);
    ImGui::Separator();
    draw_exposure(state);
    draw_views(state);
    draw_sides(state, requests);
    ImGui::Separator();
    draw_night(state);
    ImGui::Separator();
    draw_camera(state, requests);
    draw_place(state, requests);
    draw_resolution(state);
    ImGui::Checkbox("lamp markers", &state.markers);
    ImGui::SameLine();
    requests.save = ImGui::Button("save picture");
    ImGui::SameLine();
    requests.save_settings = ImGui::Button("save settings");
    ImGui::PopItemWidth();
  }
  keep_on_screen();
  ImGui::End();
  return requests;
}

std::string clock_text(double time_s) {
  const int minute = static_cast<int>(time_s / 60) + 12 * 60;
  return fmt::format("{:02}:{:02}", minute / 60 % 24, minute % 60);
}

std::string caption(const ViewerState& state, const FrameStats& stats) {
  const render::RenderSettings& settings = stats.made_with ? *stats.made_with : state.settings;
  const render::EstimatorTraits& estimator = render::traits_of(settings.sampling.estimator);
  std::string text = estimator.name;
  if (estimator.samples) text += fmt::format(", {} candidates", settings.sampling.candidates);
  if (estimator.reuses) text += fmt::format(", {} neighbours", settings.reuse.neighbours);
  if (settings.display.denoise) text += ", denoised";
  if (state.night_changes) text += ", " + clock_text(settings.time_s);
  return text + fmt::format(", mean of {} frame{}", stats.frames, stats.frames == 1 ? "" : "s");
}

}  // namespace nightcity::viewer
