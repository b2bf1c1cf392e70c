#include "runtime/viewer/panel_views.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "runtime/viewer/views.h"

namespace nightcity::viewer {
namespace {

// Typed values are bounded as dragged ones are; values of a scale differ by factors.
constexpr ImGuiSliderFlags by_factors = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic;

void draw_ends(const ViewKind& shown, render::DisplaySettings& display) {
  if (shown.is_signed) {
    float percent = 100 * display.view_highest;
    if (ImGui::SliderFloat("scale", &percent, 1, 1000, "\u00b1%.3g %%", by_factors))
      display.view_highest = percent / 100;
    return;
  }
  const std::string format = std::string("%.3g ") + shown.unit;
  ImGui::SliderFloat("from", &display.view_lowest, 1e-4f, 1e3f, format.c_str(), by_factors);
  ImGui::SliderFloat("to", &display.view_highest, 1e-3f, 1e5f, format.c_str(), by_factors);
  display.view_highest = std::max(display.view_highest, 2 * display.view_lowest);
}

}  // namespace

void draw_views(ViewerState& state, PanelRequests& requests) {
  render::DisplaySettings& display = state.settings.display;
  const auto& views = list_views();
  const ViewKind& shown = views[std::min<std::size_t>(display.view, views.size() - 1)];
  if (ImGui::BeginCombo("show", shown.name)) {
    for (const ViewKind& view : views) {
      if (ImGui::Selectable(view.name, view.view == display.view)) requests.show = &view;
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", view.help);
    }
    ImGui::EndCombo();
  }
  if (shown.unit) draw_ends(shown, display);
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

void draw_film(FilmSettings& film, bool films, PanelRequests& requests) {
  if (!ImGui::TreeNode("film of the path")) return;
  ImGui::BeginDisabled(films);
  ImGui::SliderFloat("lasts", &film.duration_s, 1, 600, "%.1f s", by_factors);
  ImGui::SliderFloat("pictures", &film.pictures_per_s, 1, 120, "%.0f a second", by_factors);
  ImGui::EndDisabled();
  if (ImGui::Button(films ? "stop the film" : "film it")) {
    requests.film = !films;
    requests.stop_film = films;
  }
  ImGui::TreePop();
}

}  // namespace nightcity::viewer
