#include "runtime/viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "runtime/viewer/drawing.h"
#include "runtime/viewer/panel_night.h"
#include "runtime/viewer/panel_settings.h"
#include "runtime/viewer/panel_views.h"

namespace nightcity::viewer {
namespace {

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
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  ImGui::Checkbox("faster above 20 m", &state.camera.speed_by_height);
}

// A key that puts the cursor in the box also sends its letter, a frame later. What was typed before
// is selected, so that a new place replaces it, and Enter alone asks for it again.
void draw_place(ViewerState& state, PanelRequests& requests) {
  if (state.focus_place > 0) ImGui::GetIO().ClearInputCharacters();
  if (state.focus_place == 2) ImGui::SetKeyboardFocusHere();
  state.focus_place = std::max(0, state.focus_place - 1);
  if (ImGui::InputTextWithHint(
          "go to", "52.516, 13.378, a street or an id", state.place.data(), state.place.size(),
          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll))
    requests.go_to = state.place.data();
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
  const float em = ImGui::GetFontSize();
  const float lines = measure_lines(state, stats, {screen.x, screen.y});
  ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
  // As wide as it needs, and no higher than leaves the lines below free: then it scrolls.
  ImGui::SetNextWindowSizeConstraints({0, 0}, {1e6f, std::max(4 * em, screen.y - lines - 14)});
  if (ImGui::Begin("nightview", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::PushItemWidth(16 * em);
    const bool opening = stats.scene.empty();
    if (opening) {
      ImGui::TextUnformatted("the scene is being opened");
    } else {
      draw_scene(state, stats, requests);
      draw_report(stats);
    }
    ImGui::Separator();
    draw_presets(requests);
    draw_governor(state, stats);
    draw_sampling(state);
    ImGui::Separator();
    draw_exposure(state);
    draw_views(state, requests);
    draw_sides(state, requests);
    ImGui::Separator();
    draw_night(state);
    ImGui::Separator();
    ImGui::BeginDisabled(opening);
    draw_camera(state, requests);
    draw_place(state, requests);
    ImGui::EndDisabled();
    draw_resolution(state);
    ImGui::Checkbox("lamp markers", &state.markers);
    ImGui::SameLine();
    ImGui::BeginDisabled(opening);
    requests.save = ImGui::Button("save picture");
    ImGui::EndDisabled();
    ImGui::SameLine();
    requests.save_settings = ImGui::Button("save settings");
    ImGui::BeginDisabled(opening);
    draw_film(state.film, stats.films, requests);
    ImGui::EndDisabled();
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
