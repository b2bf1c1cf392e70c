#include "runtime/viewer/panel_settings.h"

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "runtime/measure/exposure.h"
#include "runtime/render/presets.h"
#include "runtime/viewer/metering.h"

namespace nightcity::viewer {
namespace {

// Typed values are bounded as dragged ones are.
constexpr ImGuiSliderFlags bounded = ImGuiSliderFlags_AlwaysClamp;

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

}  // namespace

void draw_sliders(render::SettingGroup group, render::RenderSettings& settings) {
  for (const render::Setting& setting : render::list_settings())
    if (setting.group == group && setting.slider) draw_slider(setting, settings);
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

}  // namespace nightcity::viewer
