#include "runtime/viewer/comparison.h"

#include <imgui.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "runtime/render/parse.h"
#include "runtime/render/setting_table.h"

namespace nightcity::viewer {
namespace {

constexpr ImU32 name_colour = IM_COL32(255, 255, 255, 255), name_shade = IM_COL32(0, 0, 0, 160);

void draw_name(float x, float y, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled({x - 4, y - 2}, {x + size.x + 4, y + size.y + 2}, name_shade);
  list->AddText({x, y}, name_colour, text.c_str());
}

}  // namespace

bool have_same_lights(const render::RenderSettings& a, const render::RenderSettings& b) {
  return a.time_s == b.time_s && a.environment.lights == b.environment.lights;
}

render::RenderSettings change_settings(render::RenderSettings settings, const std::string& text) {
  const render::SkyGlow glow = settings.environment.glow;
  std::vector<std::pair<std::string, std::string>> values;
  for (const std::string& word : render::split_list("--compare", text)) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos)
      values.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    else if (!values.empty())
      values.back().second += "," + word;
    else
      throw UsageError("--compare", "'" + word + "': NAME=VALUE is expected, as estimator=ris");
  }
  for (const auto& [name, value] : values) {
    const auto& all = render::list_settings();
    const auto setting = std::find_if(all.begin(), all.end(),
                                      [&name = name](const auto& one) { return one.name == name; });
    if (name == "time")
      settings.time_s = render::parse_time(value);
    else if (name == "lights")
      settings.environment.lights = scene::parse_families(value);
    else if (setting != all.end())
      render::set_from_text(*setting, settings, value);
    else
      throw UsageError("--compare", "'" + name +
                                        "' is no setting: time, lights, or the name of an "
                                        "option such as estimator, without its dashes");
  }
  if (settings.environment.glow != glow)
    throw UsageError("--compare",
                     "both sides have the sky that the scene was loaded with: one of auto, "
                     "overcast and a number");
  return settings;
}

std::string describe_side(const render::RenderSettings& side, const render::RenderSettings& other) {
  std::vector<std::string> parts;
  if (side.time_s != other.time_s) parts.push_back(render::time_text(side.time_s).substr(0, 5));
  for (const render::Setting& setting : render::list_settings()) {
    const std::string text = render::text_of(setting, side);
    if (text == render::text_of(setting, other)) continue;
    parts.push_back(std::string(setting.name) + " " + text);
  }
  if (side.environment.lights != other.environment.lights)
    parts.push_back("lights " + scene::text_of(side.environment.lights));
  if (parts.empty()) parts.push_back(render::name_of(side.sampling.estimator));
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ", ") + part;
  return all;
}

void draw_comparison(Comparison& comparison, const render::RenderSettings& changed,
                     const glm::vec2& window) {
  const float em = ImGui::GetFontSize(), grip = em;
  const float x = comparison.line * window.x;
  // A window of its own that is not seen takes the mouse from the picture.
  ImGui::SetNextWindowPos({x - grip / 2, 0});
  ImGui::SetNextWindowSize({grip, window.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  if (ImGui::Begin("##line", nullptr,
                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus |
                       ImGuiWindowFlags_NoFocusOnAppearing)) {
    ImGui::InvisibleButton("grip", {grip, std::max(1.0f, window.y)});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive())
      comparison.line = std::clamp(ImGui::GetIO().MousePos.x / window.x, 0.02f, 0.98f);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddLine({x, 0}, {x, window.y}, name_colour, 2);
  const std::string mine = describe_side(changed, comparison.other),
                    others = describe_side(comparison.other, changed);
  const std::string a = "A: " + (comparison.changes_b ? others : mine),
                    b = "B: " + (comparison.changes_b ? mine : others);
  draw_name(x - ImGui::CalcTextSize(a.c_str()).x - em, em, a);
  draw_name(x + em, em, b);
}

}  // namespace nightcity::viewer
