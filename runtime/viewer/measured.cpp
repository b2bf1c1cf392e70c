#include "runtime/viewer/measured.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/markers.h"

namespace nightcity::viewer {

std::string describe_distance(const glm::vec3& from, const glm::vec3& to) {
  const glm::dvec3 way = glm::dvec3(to) - glm::dvec3(from);
  return fmt::format("{:.2f} m ({:.2f} m level, {:.2f} m {})", glm::length(way),
                     std::hypot(way.x, way.z), std::abs(way.y), way.y < 0 ? "down" : "up");
}

void draw_measured(const glm::vec3& from, const glm::vec3& to, const scene::CameraPose& pose,
                   const glm::vec2& window) {
  constexpr ImU32 yellow = IM_COL32(255, 230, 90, 255), black = IM_COL32(0, 0, 0, 170);
  const gpu::Camera camera = scene::make_camera(pose, window.x / window.y);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const auto a = scene::project(camera, from), b = scene::project(camera, to);
  const auto pixel = [&](const glm::vec2& at) { return ImVec2{at.x * window.x, at.y * window.y}; };
  if (a) list->AddCircle(pixel(*a), 5, yellow, 12, 2);
  if (!a || !b || from == to) return;
  list->AddLine(pixel(*a), pixel(*b), yellow, 2);
  const std::string text = describe_distance(from, to);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at{(pixel(*a).x + pixel(*b).x - size.x) / 2,
                  (pixel(*a).y + pixel(*b).y - size.y) / 2};
  list->AddRectFilled({at.x - 4, at.y - 2}, {at.x + size.x + 4, at.y + size.y + 2}, black);
  list->AddText(at, yellow, text.c_str());
}

}  // namespace nightcity::viewer
