// The views of the picture that the window offers: the picture itself, and quantities in false
// colours.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/render/settings.h"

namespace nightcity::viewer {

struct ViewKind {
  std::uint32_t view;  // VIEW_* of shaders/views.glsl.h
  const char* name;
  const char* help;
  const char* unit = nullptr;     // of its scale, "" for a share; null: there is no scale
  float lowest = 0, highest = 0;  // of the scale at first
  bool is_signed = false;         // the scale goes from -highest over 0 to highest, else by factors
};

/// Returns all views, in the order of their numbers.
const std::vector<ViewKind>& list_views();

/// Shows a view from now on, with its own scale.
void show_view(const ViewKind& view, render::DisplaySettings& display);

/// Returns the view of that name, with '-' for ' '. Throws UsageError.
const ViewKind& find_view(const std::string& name);

/// A kind of light and its colour (8-bit sRGB) in VIEW_KINDS.
struct KindColour {
  const char* name;
  std::uint8_t rgb[3];
};

const std::vector<KindColour>& list_kind_colours();

}  // namespace nightcity::viewer
