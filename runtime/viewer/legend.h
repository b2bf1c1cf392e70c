// Draws what the colours of a view mean.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "runtime/render/settings.h"

namespace nightcity::viewer {

/// Draws the scale of a view in false colours, or the colours of the kinds of light, at the right
/// edge of the window; nothing for the picture. `reference` says with what the picture is compared.
void draw_legend(const render::DisplaySettings& display, const std::string& reference,
                 const glm::vec2& window);

}  // namespace nightcity::viewer
