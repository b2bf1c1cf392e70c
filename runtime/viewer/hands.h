// Reads from Dear ImGui and the held keys what hands did to the picture.
#pragma once

#include "runtime/viewer/controls.h"
#include "runtime/viewer/input_queue.h"

struct ImGuiIO;

namespace nightcity::viewer {

/// Returns what hands did since the last call, inside a frame of Dear ImGui (after NewFrame). What
/// the panel uses itself is left out: the mouse over it, keys typed into its text boxes. `now_s` is
/// the time up to which events were handed over (InputQueue::handed_until).
Hands read_hands(const ImGuiIO& io, HeldKeys& keys, double now_s);

}  // namespace nightcity::viewer
