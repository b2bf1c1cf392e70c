#include "runtime/viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "runtime/measure/exposure.h"
#include "runtime/render/setting_table.h"

namespace nightcity::viewer {
namespace {

// Draws the slider of a setting, greyed where the setting makes no difference. Returns whether it
// changed.
bool draw_slider(const render::Setting& setting, render::RenderSettings& settings) {
  const render::SettingSlider& slider = *setting.slider;
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (slider.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  bool changed = false;
  ImGui::BeginDisabled(!setting.applies(settings));
  const render::Setting::Value value = setting.value(settings);
  if (const auto count = std::get_if<std::uint32_t*>(&value)) {
    const auto low = std::uint32_t(setting.min), high = std::uint32_t(slider.max);
    changed = ImGui::SliderScalar(slider.label, ImGuiDataType_U32, *count, &low, &high,
                                  slider.format, flags);
  } else if (const auto number = std::get_if<float*>(&value)) {
    changed = ImGui::SliderFloat(slider.label, *number, float(setting.min), float(slider.max),
                                 slider.format, flags);
  }
  ImGui::EndDisabled();
  return changed;
}

bool draw_sliders(render::SettingGroup group, render::RenderSettings& settings) {
  bool changed = false;
  for (const render::Setting& setting : render::list_settings())
    if (setting.group == group && setting.slider) changed |= draw_slider(setting, settings);
  return changed;
}

bool draw_estimators(render::RenderSettings& settings) {
  bool changed = false;
  render::Estimator& current = settings.sampling.estimator;
  if (ImGui::BeginCombo("estimator", render::name_of(current))) {
    for (const render::EstimatorTraits& estimator : render::list_estimators()) {
      const bool chosen = estimator.estimator == current;
      if (ImGui::Selectable(estimator.name, chosen) && !chosen) {
        current = estimator.estimator;
        changed = true;
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", estimator.description);
    }
    ImGui::EndCombo();
  }
  return changed;
}

bool draw_sampling(ViewerState& state) {
  render::RenderSettings& settings = state.settings;
  bool changed = draw_estimators(settings);
  changed |= draw_sliders(render::SettingGroup::sampling, settings);
  changed |= draw_sliders(render::SettingGroup::reuse, settings);
  changed |= draw_sliders(render::SettingGroup::indirect, settings);
  changed |= ImGui::Checkbox("accumulate", &state.accumulate);
  ImGui::SameLine();
  changed |= ImGui::Checkbox("denoise", &settings.display.denoise);
  return changed;
}

bool draw_exposure(ViewerState& state) {
  bool changed = ImGui::Checkbox("auto", &state.auto_exposure);
  ImGui::SameLine();
  if (ImGui::SliderFloat("EV100", &state.settings.display.ev100, -6, 16, "%.1f")) {
    state.auto_exposure = false;
    changed = true;
  }
  int tone = static_cast<int>(state.settings.display.tone);
  if (ImGui::Combo("curve", &tone, "linear\0reinhard\0filmic\0")) {
    state.settings.display.tone = static_cast<std::uint32_t>(tone);
    changed = true;
  }
  return changed;
}

void draw_camera(ViewerState& state, PanelRequests& requests) {
  int mode = state.fly;
  ImGui::RadioButton("orbit", &mode, 0);
  ImGui::SameLine();
  ImGui::RadioButton("fly", &mode, 1);
  state.fly = mode == 1;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("W A S D, Q and E; Shift is faster");
  for (const std::string& preset : scene::camera_presets()) {
    ImGui::SameLine();
    if (ImGui::SmallButton(preset.c_str())) requests.camera_preset = preset;
  }
  if (state.fly)
    ImGui::SliderFloat("speed", &state.speed_m_s, 0.5f, 500, "%.1f m/s",
                       ImGuiSliderFlags_Logarithmic);
}

bool draw_resolution(ViewerState& state) {
  constexpr int divisors[] = {0, 1, 2, 4, 8};
  int index = static_cast<int>(std::find(std::begin(divisors), std::end(divisors), state.divisor) -
                               divisors);
  if (!ImGui::Combo("pixels", &index, "by speed\0every\0every 2nd\0every 4th\0every 8th\0"))
    return false;
  state.divisor = divisors[index];
  return true;
}

// The clock runs from 17:00 to 07:00, which is 5 to 19 hours after noon.
bool draw_night(ViewerState& state) {
  bool changed = false;
  ImGui::BeginDisabled(!state.night_changes);
  int minutes = static_cast<int>(state.settings.time_s / 60);
  const std::string shown = clock_text(state.settings.time_s);
  if (ImGui::SliderInt("clock", &minutes, night_begin_s / 60, night_end_s / 60, shown.c_str(),
                       ImGuiSliderFlags_AlwaysClamp)) {
    state.settings.time_s = minutes * 60.0;
    changed = true;
  }
  ImGui::Checkbox("run", &state.play);
  ImGui::SameLine();
  ImGui::SliderFloat("##speed", &state.clock_speed, 1, 3600, "%.0f times",
                     ImGuiSliderFlags_Logarithmic);
  ImGui::EndDisabled();
  changed |= draw_sliders(render::SettingGroup::environment, state.settings);
  return changed;
}

void draw_report(const FrameStats& stats) {
  ImGui::Text("%u x %u, frame %u, %.1f ms", stats.width, stats.height, stats.frames,
              stats.frame_ms);
  double sum = 0;
  for (const gpu::Timer::Span& pass : stats.passes) sum += pass.ms;
  if (stats.passes.empty() || !ImGui::TreeNode("passes", "GPU %.2f ms", sum)) return;
  for (const gpu::Timer::Span& pass : stats.passes)
    ImGui::Text("%-12s %8.2f ms", pass.name.c_str(), pass.ms);
  ImGui::TreePop();
}

}  // namespace

PanelRequests draw_panel(ViewerState& state, const FrameStats& stats) {
  PanelRequests requests;
  ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({320, 0}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("nightview", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::Text("%s", stats.scene.c_str());
    ImGui::Text("%zu triangles, %zu lights", stats.triangles, stats.lights);
    ImGui::TextDisabled("%s", stats.device.c_str());
    draw_report(stats);
    ImGui::Separator();
    requests.restart |= draw_sampling(state);
    ImGui::Separator();
    requests.restart |= draw_exposure(state);
    ImGui::Separator();
    requests.restart |= draw_night(state);
    ImGui::Separator();
    draw_camera(state, requests);
    requests.restart |= draw_resolution(state);
    ImGui::Checkbox("lamp markers", &state.markers);
    ImGui::SameLine();
    requests.save = ImGui::Button("save picture");
  }
  ImGui::End();
  return requests;
}

std::string clock_text(double time_s) {
  const int minute = static_cast<int>(time_s / 60) + 12 * 60;
  return fmt::format("{:02}:{:02}", minute / 60 % 24, minute % 60);
}

std::string caption(const ViewerState& state, const FrameStats& stats) {
  const render::RenderSettings& settings = state.settings;
  const render::EstimatorTraits& estimator = render::traits_of(settings.sampling.estimator);
  std::string text = estimator.name;
  if (estimator.samples) text += fmt::format(", {} candidates", settings.sampling.candidates);
  if (estimator.reuses) text += fmt::format(", {} neighbours", settings.reuse.neighbours);
  if (settings.display.denoise) text += ", denoised";
  if (state.night_changes) text += ", " + clock_text(settings.time_s);
  return text + fmt::format(", mean of {} frame{}", stats.frames, stats.frames == 1 ? "" : "s");
}

}  // namespace nightcity::viewer
