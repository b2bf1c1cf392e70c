#include "runtime/experiments/governed.h"

#include <limits>

namespace nightcity::experiments {

std::vector<render::Rung> measure_rungs(
    const std::function<render::Renderer()>& make_renderer,
    const std::vector<std::vector<render::Moment>>& places, const render::RenderSettings& settings,
    bool errors, const std::function<void(std::size_t, std::size_t)>& progress) {
  constexpr double whole = std::numeric_limits<double>::infinity();
  render::RungMeter meter(std::unique_ptr<render::Renderer>(new render::Renderer(make_renderer())),
                          places, settings, render::list_rungs(settings), errors);
  std::size_t measured = 0;
  while (!meter.work(whole, whole))
    if (meter.measured() > measured) progress(++measured, meter.count());
  return meter.take();
}

}  // namespace nightcity::experiments
