// The panel's widgets for what of the picture is shown, and for what is kept of it.
#pragma once

#include "runtime/viewer/panel.h"

namespace nightcity::viewer {

void draw_views(ViewerState& state, PanelRequests& requests);

/// Draws the beginning and the end of a comparison of two pictures.
void draw_sides(const ViewerState& state, PanelRequests& requests);

/// Draws what begins and stops a film; `films`: one is being recorded.
void draw_film(FilmSettings& film, bool films, PanelRequests& requests);

}  // namespace nightcity::viewer
