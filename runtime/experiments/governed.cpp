#include "runtime/experiments/governed.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "runtime/experiments/experiment.h"
#include "runtime/measure/noise.h"

namespace nightcity::experiments {
namespace {

constexpr std::uint32_t seeds = 3, lead_frames = 4;

void render_frame(render::Renderer& renderer, const scene::CameraPose& pose,
                  const render::RenderSettings& settings, const render::Effort& effort) {
  constexpr double whole = std::numeric_limits<double>::infinity();
  renderer.begin_frame(pose, settings, effort);
  while (!renderer.continue_frame(whole, whole)) {
  }
}

}  // namespace

std::vector<Moment> at_rest(const scene::CameraPose& pose, double time_s) {
  return std::vector<Moment>(rung_frames, Moment{pose, time_s});
}

std::vector<render::Rung> measure_rungs(
    const std::function<render::Renderer()>& make_renderer,
    const std::vector<std::vector<Moment>>& places, const render::RenderSettings& settings,
    bool errors, const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<render::Rung> rungs = list_rungs(settings);
  render::Renderer renderer = make_renderer();
  render::RenderSettings each = settings;
  each.averaging.accumulate = false;  // every frame stands alone, as in a flight
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    for (const std::vector<Moment>& place : places) {
      std::vector<measure::Image> pictures;
      std::vector<double> ms;
      for (std::uint32_t seed = 0; seed < (errors ? seeds : 1); ++seed) {
        each.sampling.seed = settings.sampling.seed + seed;
        for (std::size_t frame = 0; frame < place.size(); ++frame) {
          each.time_s = place[frame].time_s;
          render_frame(renderer, place[frame].pose, each, rungs[i].effort);
          if (frame >= lead_frames) ms.push_back(sum_gpu_ms(renderer));
        }
        if (errors) pictures.push_back(renderer.download(false));
      }
      std::sort(ms.begin(), ms.end(), std::greater<>());
      rungs[i].ms = std::max(rungs[i].ms, ms.at(1));
      if (errors)
        rungs[i].relative_error =
            std::max(rungs[i].relative_error, measure::find_relative_noise(pictures));
    }
    progress(i + 1, rungs.size());
  }
  // Less work takes no longer: where it seemed to, something else held the device up.
  for (std::size_t i = rungs.size() - 1; i > 0; --i)
    rungs[i - 1].ms = std::min(rungs[i - 1].ms, rungs[i].ms);
  return rungs;
}

std::string describe(const render::Governor& governor, const render::Governor::Decision& decision) {
  return fmt::format("frame {}: {} instead of {}, {:.3g} ms expected: {}", decision.frame,
                     governor.rungs()[decision.to].name(), governor.rungs()[decision.from].name(),
                     decision.expected_ms, decision.reason);
}

std::string describe_start(const render::Governor& governor,
                           const render::GovernorOptions& options) {
  std::string text;
  for (const render::Rung& rung : governor.rungs()) {
    text += fmt::format("{}{}: {:.3g} ms", text.empty() ? "" : "; ", rung.name(), rung.ms);
    if (rung.relative_error > 0) text += fmt::format(", noise {:.3g}", rung.relative_error);
  }
  text = "measured " + text + ". Starts with " + governor.rungs()[governor.rung()].name();
  if (!governor.can_keep_target())
    text += fmt::format(": none keeps a noise of {:g}", options.target_error);
  if (options.budget_ms > 0 && governor.rungs().front().ms > options.budget_ms)
    text += fmt::format(": none keeps {:g} ms", options.budget_ms);
  return text;
}

}  // namespace nightcity::experiments
