#include "runtime/viewer/legend.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/measure/false_colour.h"
#include "runtime/viewer/views.h"

namespace nightcity::viewer {
namespace {

constexpr ImU32 label_colour = IM_COL32(255, 255, 255, 255), label_shade = IM_COL32(0, 0, 0, 170);

ImU32 colour_of(const ViewKind& view, double share) {
  const auto rgb =
      view.is_signed ? measure::signed_colour_at(2 * share - 1) : measure::colour_at(share);
  return IM_COL32(rgb[0], rgb[1], rgb[2], 255);
}

// A label of a scale at a share of its length.
struct Tick {
  double share;
  std::string label;
};

// Returns a label for each decade, or for the ends, the middle and the halves of a signed scale.
std::vector<Tick> make_ticks(const ViewKind& view, const render::DisplaySettings& display) {
  std::vector<Tick> ticks;
  if (view.is_signed) {
    for (const double at : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const double value = 100 * at * double(display.view_highest);
      ticks.push_back({(at + 1) / 2, at == 0 ? fmt::format("0 {}", view.unit)
                                             : fmt::format("{:+.3g} {}", value, view.unit)});
    }
    return ticks;
  }
  const double low = std::log10(double(display.view_lowest)),
               high = std::log10(double(display.view_highest));
  for (double decade = std::ceil(low - 1e-6); decade <= high + 1e-6; ++decade)
    ticks.push_back(
        {(decade - low) / (high - low), fmt::format("{:g} {}", std::pow(10.0, decade), view.unit)});
  return ticks;
}

// Draws a bar from the lowest value below to the highest on top, with its labels.
void draw_scale(const ViewKind& view, const render::DisplaySettings& display,
                const glm::vec2& window) {
  const float em = ImGui::GetFontSize(), height = std::min(20 * em, window.y - 8 * em), width = em,
              label_width = 7 * em;
  if (height < 4 * em || window.x < 2 * label_width) return;
  const float right = window.x - em, left = right - width, top = (window.y - height) / 2;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled({left - label_width, top - 2 * em}, {right + em / 2, top + height + em},
                      label_shade);
  list->AddText({left - label_width + em / 2, top - 1.7f * em}, label_colour, view.name);
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const double low = double(i) / steps, high = (i + 1.0) / steps;
    const ImU32 from = colour_of(view, low), to = colour_of(view, high);
    list->AddRectFilledMultiColor({left, top + height * float(1 - high)},
                                  {right, top + height * float(1 - low)}, to, to, from, from);
  }
  for (const Tick& tick : make_ticks(view, display)) {
    const float y = top + height * float(1 - tick.share);
    const float text = ImGui::CalcTextSize(tick.label.c_str()).x;
    list->AddText({left - text - em / 2, y - em / 2}, label_colour, tick.label.c_str());
    list->AddLine({left - em / 4, y}, {left + em / 4, y}, label_colour);
  }
}

// Draws what the picture is compared with below the scale.
void draw_reference(const std::string& reference, const glm::vec2& window) {
  const float em = ImGui::GetFontSize(), bar = std::min(20 * em, window.y - 8 * em);
  const float left = window.x - em - ImGui::CalcTextSize(reference.c_str()).x,
              top = (window.y + bar) / 2 + 1.2f * em;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled({left - em / 2, top - em / 5}, {window.x - em / 2, top + 1.3f * em},
                      label_shade);
  list->AddText({left, top}, label_colour, reference.c_str());
}

void draw_kinds(const glm::vec2& window) {
  const float em = ImGui::GetFontSize(), width = 10 * em;
  const auto& kinds = list_kind_colours();
  const float left = window.x - width, top = window.y / 2 - float(kinds.size()) * em;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled({left - em / 2, top - em / 2},
                      {window.x, top + 1.5f * em * float(kinds.size()) + em / 2}, label_shade);
  float y = top;
  for (const KindColour& kind : kinds) {
    list->AddRectFilled({left, y}, {left + em, y + em},
                        IM_COL32(kind.rgb[0], kind.rgb[1], kind.rgb[2], 255));
    list->AddText({left + 1.5f * em, y}, label_colour, kind.name);
    y += 1.5f * em;
  }
}

}  // namespace

void draw_legend(const render::DisplaySettings& display, const std::string& reference,
                 const glm::vec2& window) {
  if (display.view >= list_views().size()) return;
  const ViewKind& view = list_views()[display.view];
  if (view.unit) draw_scale(view, display, window);
  if (!reference.empty()) draw_reference(reference, window);
  if (display.view == VIEW_KINDS) draw_kinds(window);
}

}  // namespace nightcity::viewer
