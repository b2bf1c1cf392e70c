#include "runtime/viewer/compass.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace nightcity::viewer {
namespace {

constexpr ImU32 ink = IM_COL32(255, 255, 255, 230), needle = IM_COL32(255, 90, 70, 255),
                backdrop = IM_COL32(0, 0, 0, 140);

}  // namespace

ScaleBar find_scale_bar(const scene::CameraPose& pose, float distance_m, float height_px,
                        float most_px) {
  const double metres_per_px =
      2 * std::tan(glm::radians(double(pose.fov_deg)) / 2) * double(distance_m) / double(height_px);
  const double most_m = metres_per_px * double(most_px);
  if (!(most_m > 1e-6) || !std::isfinite(most_m)) return {};
  const double decade = std::pow(10.0, std::floor(std::log10(most_m)));
  const double metres = most_m >= 5 * decade   ? 5 * decade
                        : most_m >= 2 * decade ? 2 * decade
                                               : decade;
  return {metres, static_cast<float>(metres / metres_per_px)};
}

double find_bearing(const scene::CameraPose& pose) {
  glm::vec3 ahead = pose.target - pose.position;
  if (std::hypot(ahead.x, ahead.z) < 1e-4f * glm::length(ahead)) ahead = pose.up;
  const double bearing = glm::degrees(std::atan2(double(ahead.x), -double(ahead.z)));
  return bearing < 0 ? bearing + 360 : bearing;
}

void draw_compass(const CameraControl& camera, const glm::vec2& window) {
  const float em = ImGui::GetFontSize(), radius = 1.6f * em;
  if (window.x < 20 * em || window.y < 14 * em) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImVec2 centre{window.x - 2 * em - radius, 2 * em + radius};
  list->AddCircleFilled(centre, radius + 0.8f * em, backdrop, 32);
  const double turn = glm::radians(find_bearing(camera.pose));
  // North on the picture, where up is ahead.
  const ImVec2 north{-float(std::sin(turn)), -float(std::cos(turn))}, side{-north.y, north.x};
  const auto at = [&](float along, float across) {
    return ImVec2{centre.x + radius * (along * north.x + across * side.x),
                  centre.y + radius * (along * north.y + across * side.y)};
  };
  list->AddTriangleFilled(at(1, 0), at(0, 0.25f), at(0, -0.25f), needle);
  list->AddTriangleFilled(at(-1, 0), at(0, 0.25f), at(0, -0.25f), ink);
  const ImVec2 letter = at(1.35f, 0), size = ImGui::CalcTextSize("N");
  list->AddText({letter.x - size.x / 2, letter.y - size.y / 2}, ink, "N");

  const glm::vec3 seen = camera.pivot.value_or(camera.pose.target);
  const ScaleBar bar =
      find_scale_bar(camera.pose, glm::distance(seen, camera.pose.position), window.y, 10 * em);
  if (bar.pixels <= 0) return;
  const std::string label = bar.metres >= 1000 ? fmt::format("{:g} km", bar.metres / 1000)
                                               : fmt::format("{:g} m", bar.metres);
  const float right = window.x - em, left = right - bar.pixels, y = window.y - 1.2f * em;
  const float text = ImGui::CalcTextSize(label.c_str()).x;
  list->AddRectFilled({std::min(left, right - text) - em / 2, y - 1.6f * em},
                      {right + em / 2, y + em / 2}, backdrop);
  list->AddLine({left, y}, {right, y}, ink, 2);
  list->AddLine({left, y - 4}, {left, y + 4}, ink, 2);
  list->AddLine({right, y - 4}, {right, y + 4}, ink, 2);
  list->AddText({right - text, y - 1.5f * em}, ink, label.c_str());
}

}  // namespace nightcity::viewer
