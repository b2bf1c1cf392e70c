#include "runtime/viewer/hands.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <cmath>

namespace nightcity::viewer {

Hands read_hands(const ImGuiIO& io, HeldKeys& keys, double now_s) {
  Hands hands;
  const bool has_cursor = std::abs(io.MousePos.x) < 1e6f && std::abs(io.MousePos.y) < 1e6f;
  if (has_cursor) {
    hands.cursor = {io.MousePos.x, io.MousePos.y};
    const glm::vec2 step(io.MouseDelta.x, io.MouseDelta.y);
    // A button that was pressed over the panel is the panel's until it is released, and one that
    // was pressed over the picture is the picture's. A press ends a frame of the queue, so a motion
    // in the same frame came before it.
    const auto pressed = [&](ImGuiMouseButton button) {
      return ImGui::IsMouseClicked(button) && !io.MouseDownOwned[button];
    };
    const auto dragged = [&](ImGuiMouseButton button) {
      return !io.MouseDownOwned[button] &&
             (ImGui::IsMouseDown(button) ? !ImGui::IsMouseClicked(button)
                                         : ImGui::IsMouseReleased(button));
    };
    hands.pressed = pressed(ImGuiMouseButton_Left) || pressed(ImGuiMouseButton_Right) ||
                    pressed(ImGuiMouseButton_Middle);
    constexpr float still_px = 4;  // a hand shakes
    // The last motion may lie in the frame of the release.
    const ImVec2 from = io.MouseClickedPos[ImGuiMouseButton_Left];
    hands.clicked =
        ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
        !io.MouseDownOwned[ImGuiMouseButton_Left] &&
        io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < still_px * still_px &&
        std::hypot(io.MousePos.x - from.x, io.MousePos.y - from.y) < still_px;
    if (dragged(ImGuiMouseButton_Left)) hands.drag = step;
    if (dragged(ImGuiMouseButton_Right) || dragged(ImGuiMouseButton_Middle)) hands.pan = step;
    if (!io.WantCaptureMouse) hands.scroll = io.MouseWheel;
  }
  if (!io.WantTextInput) {
    const auto held = [&](int key) { return keys.held_s(key, now_s); };
    hands.held_s = {held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_E) - held(GLFW_KEY_Q),
                    held(GLFW_KEY_W) - held(GLFW_KEY_S)};
    hands.fast = io.KeyShift;
  }
  keys.take_all(now_s);
  return hands;
}

}  // namespace nightcity::viewer
