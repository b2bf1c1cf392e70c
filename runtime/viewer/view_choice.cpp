#include "runtime/viewer/view_choice.h"

#include <algorithm>

namespace nightcity::viewer {
namespace {

View make_view(const ViewerState& state, const render::RenderSettings& settings,
               const ViewConditions& conditions) {
  View view{state.camera.pose, settings, glm::max(conditions.window, glm::uvec2(1))};
  render::keep_what_view_needs(settings.display.view, view.settings.sampling);
  view.settings.averaging.accumulate = state.accumulate;
  view.divisor = static_cast<std::uint32_t>(state.divisor);
  view.max_frames = conditions.max_frames;
  view.runs = conditions.runs;
  view.governor = state.governor;
  view.switches = conditions.switches;
  return view;
}

// Returns the settings of the same picture by the reference estimator.
render::RenderSettings to_reference(render::RenderSettings settings) {
  settings.sampling.estimator = render::Estimator::reference;
  settings.sampling.resolution_scale = 1;
  // The picture may be the reference's too: the two must not share their random numbers.
  settings.sampling.seed += 1;
  settings.display.denoise = false;
  settings.display.view = VIEW_PICTURE;
  return settings;
}

render::RenderSettings to_other_side(const ViewerState& state) {
  render::RenderSettings other = state.compare.other;
  const bool denoise = other.display.denoise;
  other.display = state.settings.display;
  other.display.denoise = denoise;
  return other;
}

}  // namespace

ViewerState make_state(const ViewOptions& options) {
  ViewerState state;
  state.settings = options.settings;
  if (options.compared) {
    state.compare.on = true;
    state.compare.other = *options.compared;
  }
  state.markers = options.markers;
  state.divisor = options.divisor;
  state.governor = options.governor;
  state.budget_ms = static_cast<float>(options.governor.budget_ms);
  state.target_error = static_cast<float>(options.governor.target_error);
  state.auto_exposure = !options.ev100;
  if (options.ev100) state.settings.display.ev100 = *options.ev100;
  state.play = options.play;
  return state;
}

Beside choose_beside(const ViewerState& state) {
  if (state.compare.on) return Beside::side;
  return state.settings.display.view == VIEW_DIFFERENCE ? Beside::reference : Beside::nothing;
}

Views choose_views(const ViewerState& state, const ViewConditions& conditions) {
  Views views{make_view(state, state.settings, conditions), std::nullopt, true};
  const Beside beside = choose_beside(state);
  if (beside == Beside::nothing) return views;
  views.other = make_view(
      state, beside == Beside::reference ? to_reference(state.settings) : to_other_side(state),
      conditions);
  views.view.governor = views.other->governor = {};  // two pictures share the device
  views.same_lights = have_same_lights(state.settings, views.other->settings);
  if (views.same_lights) return views;
  // Each change of lights begins a mean anew, so each side gets its frames at one go.
  constexpr std::uint32_t frames_by_turns = 16;
  views.view.max_frames = views.other->max_frames =
      std::min(conditions.max_frames, frames_by_turns);
  return views;
}

}  // namespace nightcity::viewer
