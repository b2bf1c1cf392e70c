// Chooses what the window's pictures are to show.
#pragma once

#include "runtime/viewer/panel.h"
#include "runtime/viewer/viewer.h"
#include "runtime/viewer/workbench.h"

namespace nightcity::viewer {

/// Returns the state with which the window begins.
ViewerState make_state(const ViewOptions& options);

/// The choice depends on these besides the panel's state.
struct ViewConditions {
  glm::uvec2 window{1};          // pixels
  std::uint32_t max_frames = 0;  // in the mean
  bool runs = false;             // the clock runs
  bool switches = false;         // lights will be switched soon: DeviceScene::switching()
};

/// Returns what a second picture is for.
Beside choose_beside(const ViewerState& state);

Views choose_views(const ViewerState& state, const ViewConditions& conditions);

}  // namespace nightcity::viewer
