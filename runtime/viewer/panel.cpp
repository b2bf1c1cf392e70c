#include "runtime/viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "runtime/measure/exposure.h"

namespace nightcity {
namespace {

bool slider(const char* label, std::uint32_t& value, std::uint32_t low, std::uint32_t high,
            ImGuiSliderFlags flags = 0) {
  return ImGui::SliderScalar(label, ImGuiDataType_U32, &value, &low, &high, "%u",
                             flags | ImGuiSliderFlags_AlwaysClamp);
}

bool estimator_choice(RenderSettings& settings) {
  bool changed = false;
  if (ImGui::BeginCombo("estimator", name_of(settings.estimator))) {
    for (const EstimatorName& entry : estimator_names()) {
      const bool chosen = entry.estimator == settings.estimator;
      if (ImGui::Selectable(entry.name, chosen) && !chosen) {
        settings.estimator = entry.estimator;
        changed = true;
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", entry.description);
    }
    ImGui::EndCombo();
  }
  return changed;
}

bool sampling(ViewerState& state) {
  RenderSettings& settings = state.settings;
  bool changed = estimator_choice(settings);
  const bool reference = settings.estimator == Estimator::reference;
  ImGui::BeginDisabled(reference);
  changed |= slider("candidates", settings.candidates, 1, 128, ImGuiSliderFlags_Logarithmic);
  ImGui::BeginDisabled(settings.estimator == Estimator::ris);
  changed |= slider("neighbours", settings.neighbours, 0, max_neighbours);
  changed |= ImGui::SliderFloat("history", &settings.history_cap, 0, 40, "%.0f frames");
  ImGui::EndDisabled();
  ImGui::EndDisabled();
  changed |= ImGui::Checkbox("accumulate", &state.accumulate);
  ImGui::SameLine();
  changed |= ImGui::Checkbox("denoise", &state.settings.denoise);
  return changed;
}

bool exposure(ViewerState& state) {
  bool changed = ImGui::Checkbox("auto", &state.auto_exposure);
  ImGui::SameLine();
  if (ImGui::SliderFloat("EV100", &state.settings.ev100, -6, 16, "%.1f")) {
    state.auto_exposure = false;
    changed = true;
  }
  int tone = static_cast<int>(state.settings.tone);
  if (ImGui::Combo("curve", &tone, "linear\0reinhard\0filmic\0")) {
    state.settings.tone = static_cast<std::uint32_t>(tone);
    changed = true;
  }
  return changed;
}

void camera(ViewerState& state, PanelRequests& requests) {
  int mode = state.fly;
  ImGui::RadioButton("orbit", &mode, 0);
  ImGui::SameLine();
  ImGui::RadioButton("fly", &mode, 1);
  state.fly = mode == 1;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("W A S D, Q and E; Shift is faster");
  for (const std::string& preset : camera_presets()) {
    ImGui::SameLine();
    if (ImGui::SmallButton(preset.c_str())) requests.camera_preset = preset;
  }
  if (state.fly)
    ImGui::SliderFloat("speed", &state.speed_m_s, 0.5f, 500, "%.1f m/s",
                       ImGuiSliderFlags_Logarithmic);
}

bool resolution(ViewerState& state) {
  constexpr int divisors[] = {0, 1, 2, 4, 8};
  int index = static_cast<int>(std::find(std::begin(divisors), std::end(divisors), state.divisor) -
                               divisors);
  if (!ImGui::Combo("pixels", &index,
                    "as many as are quick\0every\0every 2nd\0every 4th\0every 8th\0"))
    return false;
  state.divisor = divisors[index];
  return true;
}

// 17:00 to 07:00, in minutes after noon.
bool night(ViewerState& state) {
  bool changed = false;
  ImGui::BeginDisabled(!state.night_changes);
  int minutes = static_cast<int>(state.settings.time_s / 60);
  const std::string shown = clock_text(state.settings.time_s);
  if (ImGui::SliderInt("clock", &minutes, 5 * 60, 19 * 60, shown.c_str(),
                       ImGuiSliderFlags_AlwaysClamp)) {
    state.settings.time_s = minutes * 60.0;
    changed = true;
  }
  ImGui::Checkbox("run", &state.play);
  ImGui::SameLine();
  ImGui::SliderFloat("##speed", &state.clock_speed, 1, 3600, "%.0f times",
                     ImGuiSliderFlags_Logarithmic);
  ImGui::EndDisabled();
  changed |= ImGui::SliderFloat("wet streets", &state.settings.wetness, 0, 1, "%.2f");
  return changed;
}

void report(const ViewerFigures& figures) {
  ImGui::Text("%u x %u, frame %u, %.1f ms", figures.width, figures.height, figures.frames,
              figures.frame_ms);
  double sum = 0;
  for (const gpu::Timer::Span& pass : figures.passes) sum += pass.ms;
  if (figures.passes.empty() || !ImGui::TreeNode("passes", "GPU %.2f ms", sum)) return;
  for (const gpu::Timer::Span& pass : figures.passes)
    ImGui::Text("%-12s %8.2f ms", pass.name.c_str(), pass.ms);
  ImGui::TreePop();
}

}  // namespace

PanelRequests draw_panel(ViewerState& state, const ViewerFigures& figures) {
  PanelRequests requests;
  ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({320, 0}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("nightview", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::Text("%s", figures.scene.c_str());
    ImGui::Text("%zu triangles, %zu lights", figures.triangles, figures.lights);
    ImGui::TextDisabled("%s", figures.device.c_str());
    report(figures);
    ImGui::Separator();
    requests.restart |= sampling(state);
    ImGui::Separator();
    requests.restart |= exposure(state);
    ImGui::Separator();
    requests.restart |= night(state);
    ImGui::Separator();
    camera(state, requests);
    requests.restart |= resolution(state);
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

std::string caption(const ViewerState& state, const ViewerFigures& figures) {
  const RenderSettings& settings = state.settings;
  std::string text = name_of(settings.estimator);
  if (settings.estimator != Estimator::reference) {
    text += fmt::format(", {} candidates", settings.candidates);
    if (settings.estimator != Estimator::ris)
      text += fmt::format(", {} neighbours", settings.neighbours);
  }
  if (settings.denoise) text += ", denoised";
  if (state.night_changes) text += ", " + clock_text(settings.time_s);
  return text + fmt::format(", mean of {} frame{}", figures.frames, figures.frames == 1 ? "" : "s");
}

}  // namespace nightcity
