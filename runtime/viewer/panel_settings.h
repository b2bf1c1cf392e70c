// The panel's widgets for how pictures are made: sampling, exposure, pixels.
#pragma once

#include "runtime/render/setting_table.h"
#include "runtime/viewer/panel.h"

namespace nightcity::viewer {

/// Draws the sliders of a group of settings, greyed where they make no difference.
void draw_sliders(render::SettingGroup group, render::RenderSettings& settings);

void draw_sampling(ViewerState& state);
void draw_exposure(ViewerState& state);
void draw_presets(PanelRequests& requests);
void draw_governor(ViewerState& state, const FrameStats& stats);
void draw_resolution(ViewerState& state);

}  // namespace nightcity::viewer
