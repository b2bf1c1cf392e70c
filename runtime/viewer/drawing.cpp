#include "runtime/viewer/drawing.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "formats/rgb9e5.h"
#include "runtime/scene/markers.h"
#include "runtime/scene/trace_ray.h"
#include "runtime/viewer/keys.h"

namespace nightcity::viewer {
namespace {

constexpr ImU32 white = IM_COL32(255, 255, 255, 255), grey = IM_COL32(190, 190, 190, 255),
                red = IM_COL32(255, 120, 100, 255), black = IM_COL32(0, 0, 0, 255);

// Text that can be read over any picture: wrapped to the width and shadowed.
void draw_text(const ImVec2& at, ImU32 colour, const std::string& text, float wrap_width) {
  ImDrawList* list = ImGui::GetForegroundDrawList();
  ImFont* font = ImGui::GetFont();
  const float size = ImGui::GetFontSize();
  list->AddText(font, size, {at.x + 1, at.y + 1}, black, text.c_str(), nullptr, wrap_width);
  list->AddText(font, size, at, colour, text.c_str(), nullptr, wrap_width);
}

constexpr float margin = 12;

float find_wrap_width(const glm::vec2& window) {
  return std::max(50.0f, window.x - 2 * margin);
}

// With the space to the line below it; an empty text takes none.
float height_of(const std::string& text, float wrap_width) {
  return text.empty() ? 0 : ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap_width).y + 2;
}

std::string join(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
  return text;
}

}  // namespace

std::string make_bottom_line(const ViewerState& state, const FrameStats& stats) {
  if (stats.scene.empty()) return "";
  std::string text = caption(state, stats);
  if (stats.divisor > 1)
    text +=
        ", every " + std::to_string(stats.divisor) + (stats.divisor == 2 ? "nd" : "th") + " pixel";
  if (!stats.work.empty()) text += " - " + stats.work;
  return text;
}

void draw_lines(const ViewerState& state, const FrameStats& stats, const Notices& notices,
                const glm::vec2& window) {
  const float wrap = find_wrap_width(window);
  float y = window.y - margin / 2;
  const auto draw = [&](const std::string& text, ImU32 colour) {
    if (text.empty()) return;
    y -= height_of(text, wrap);
    draw_text({margin, y}, colour, text, wrap);
  };
  draw(make_bottom_line(state, stats), white);
  draw(join(stats.licences), grey);
  for (auto line = notices.lines().rbegin(); line != notices.lines().rend(); ++line)
    draw(line->text, line->is_error ? red : white);
}

float measure_lines(const ViewerState& state, const FrameStats& stats, const glm::vec2& window) {
  const float wrap = find_wrap_width(window);
  return margin / 2 + height_of(make_bottom_line(state, stats), wrap) +
         height_of(join(stats.licences), wrap);
}

void draw_middle(const std::string& text, const glm::vec2& window) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  draw_text({std::max(0.0f, (window.x - size.x) / 2), std::max(0.0f, (window.y - size.y) / 2)},
            white, text, 0);
}

void draw_pick(std::optional<Pick>& picked, double luminance_cd_m2, const scene::RenderScene& scene,
               const scene::CameraPose& pose, const glm::vec2& window) {
  if (!picked) return;
  const gpu::Camera camera = scene::make_camera(pose, window.x / window.y);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const auto place = [&](const glm::vec3& point) { return scene::project(camera, point); };
  if (const auto at = place(picked->point)) {
    const ImVec2 here{at->x * window.x, at->y * window.y};
    for (const PickedLight& light : picked->strongest)
      if (const auto to = place(scene.lights[light.light].position))
        list->AddLine(here, {to->x * window.x, to->y * window.y}, IM_COL32(255, 220, 120, 140));
    list->AddCircle(here, 6, white, 16, 2);
  }
  bool open = true;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({window.x - 10, 10}, ImGuiCond_Appearing, {1, 0});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x, std::max(4 * em, window.y - 3 * em)});
  if (ImGui::Begin("here", &open, ImGuiWindowFlags_AlwaysAutoResize)) {
    for (const std::string& line : picked->lines) ImGui::TextUnformatted(line.c_str());
    if (picked->emitter) {
      ImGui::Text("shines: %s", picked->emitter->name.c_str());
      ImGui::TextDisabled("%s", picked->emitter->sources.c_str());
    }
    ImGui::Text("%.3g cd/m2 in the picture so far", luminance_cd_m2);
    ImGui::Text("%.3g lx straight from %zu lights (without vehicles)", picked->lux, picked->lights);
    for (const PickedLight& light : picked->strongest) {
      ImGui::Text("%5.1f %%  %8.3g lx  %5.1f m  %s", 100 * light.share, light.lux, light.distance_m,
                  light.name.c_str());
      if (!light.sources.empty()) ImGui::TextDisabled("    %s", light.sources.c_str());
    }
  }
  ImGui::End();
  if (!open) picked.reset();
}

void draw_help(bool& open, const glm::vec2& window) {
  if (!open) return;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x, window.y});
  if (ImGui::Begin("keys and mouse", &open,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoCollapse)) {
    const auto row = [](const char* name, const char* help) {
      ImGui::TextUnformatted(name);
      ImGui::SameLine(13 * ImGui::GetFontSize());
      ImGui::TextUnformatted(help);
    };
    for (const KeyBinding& key : list_keys()) row(key.keys, key.help);
    ImGui::Separator();
    for (const auto& [gesture, effect] : list_gestures()) row(gesture, effect);
  }
  ImGui::End();
}

void draw_markers(const scene::RenderScene& scene, const scene::CameraPose& pose,
                  const glm::vec2& window) {
  // ImGui's indices end at 65,535 vertices per list, and rays are to take a few milliseconds.
  constexpr std::size_t max_markers = 2000;
  const gpu::Camera camera = scene::make_camera(pose, window.x / window.y);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  auto markers = scene::find_markers(camera, scene.lights, 20 * max_markers);
  std::erase_if(markers, [&](const scene::Marker& marker) {
    return scene.families[marker.light] == LightFamily::window;
  });
  if (markers.size() > max_markers)  // the nearest are last
    markers.erase(markers.begin(), markers.end() - static_cast<std::ptrdiff_t>(max_markers));
  for (const scene::Marker& marker : markers) {
    const glm::vec3 at_lamp = scene.lights[marker.light].position;
    const glm::dvec3 way = glm::dvec3(at_lamp) - glm::dvec3(pose.position);
    // The lamp's own housing does not hide it.
    const double reach = 1 - 0.5 / std::max(1.0, glm::length(way));
    if (scene::trace_ray(scene, glm::dvec3(pose.position), way, reach, MASK_SHADOW)) continue;
    const glm::vec3 colour = decode_rgb9e5(scene.lights[marker.light].colour_rgb9e5);
    const float brightest = std::max({colour.r, colour.g, colour.b, 1e-6f});
    const ImU32 packed = ImGui::ColorConvertFloat4ToU32(
        {colour.r / brightest, colour.g / brightest, colour.b / brightest, 0.9f});
    const ImVec2 at{marker.at.x * window.x, marker.at.y * window.y};
    list->AddCircle(at, std::clamp(200.0f / marker.distance, 2.0f, 12.0f), packed, 8, 1.5f);
  }
}

bool close_innermost() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  if (context.OpenPopupStack.Size > 0) {
    ImGui::ClosePopupToLevel(context.OpenPopupStack.Size - 1, true);
    return true;
  }
  return ImGui::GetIO().WantTextInput;  // a text box drops what was typed by itself
}

}  // namespace nightcity::viewer
