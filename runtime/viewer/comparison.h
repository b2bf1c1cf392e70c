// Two pictures of one view side by side, A left and B right of a line that the user drags.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "runtime/render/settings.h"

namespace nightcity::viewer {

struct Comparison {
  bool on = false;
  float line = 0.5f;               // its place, as a share of the window's width
  bool changes_b = true;           // the panel changes B, and A is the other; or the reverse
  render::RenderSettings other{};  // of the side that the panel does not change
};

/// Returns whether both need the same lights to shine, so that they can be rendered by turns.
bool have_same_lights(const render::RenderSettings& a, const render::RenderSettings& b);

/// Returns `settings` with a list of others, "estimator=ris,time=23:00,lights=window": a name of
/// list_settings(), time or lights. Words after a comma that have no '=' belong to the value
/// before. Throws UsageError.
render::RenderSettings change_settings(render::RenderSettings settings, const std::string& text);

/// Returns what differs between the settings of a side and those of the other: "ris, 23:00"; the
/// estimator where nothing does.
std::string describe_side(const render::RenderSettings& side, const render::RenderSettings& other);

/// Draws the line and the names of both sides, and lets the mouse drag the line.
void draw_comparison(Comparison& comparison, const render::RenderSettings& changed,
                     const glm::vec2& window);

}  // namespace nightcity::viewer
