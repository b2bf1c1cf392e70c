#include "runtime/viewer/pace.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace nightcity::viewer {
namespace {

constexpr std::uint32_t coarsest = 8;
constexpr double step_m = 0.3;  // a frame: 18 m/s at 60 frames a second

bool is_on(const render::GovernorOptions& options) {
  return options.budget_ms > 0 || options.target_error > 0;
}

bool has_same_pace(const PaceOf& a, const PaceOf& b) {
  return a.options.budget_ms == b.options.budget_ms &&
         a.options.target_error == b.options.target_error && a.window == b.window &&
         a.divisor == b.divisor && render::have_same_estimate(a.settings, b.settings);
}

}  // namespace

void Pace::set(const PaceOf& shown) {
  if (shown_ && has_same_pace(*shown_, shown)) return;
  stop();
  shown_ = shown;
  meter_.reset();
  governor_.reset();
  frames_ = within_ = 0;
  if (!is_on(shown.options)) return;
  if (shown.divisor != 0)
    start_meter(shown.divisor, false);
  else if (shown.options.budget_ms > 0)
    start_meter(coarsest, true);
  else
    start_meter(1, false);
}

bool Pace::is_settled(const PaceOf& shown) const {
  return !meter_ && (shown_ ? has_same_pace(*shown_, shown) : !is_on(shown.options));
}

void Pace::start_meter(std::uint32_t divisor, bool cheapest_alone) {
  divisor_ = divisor;
  seeks_size_ = cheapest_alone;
  const glm::uvec2 size = glm::max(shown_->window / divisor, glm::uvec2(1));
  std::vector<render::Rung> rungs = render::list_rungs(shown_->settings);
  if (cheapest_alone)
    rungs = {*std::find_if(rungs.begin(), rungs.end(), [](const render::Rung& rung) {
      return rung.effort.resolution_scale == 1 && !rung.effort.half_rate;
    })};
  const std::vector<std::vector<render::Moment>> places{
      render::moving_aside(shown_->pose, shown_->settings.time_s, step_m)};
  meter_ = std::make_unique<render::RungMeter>(
      std::make_unique<render::Renderer>(device_, passes_, scene_, size.x, size.y), places,
      shown_->settings, std::move(rungs), shown_->options.target_error > 0 && !cheapest_alone);
}

void Pace::measure(double slice_s, double wait_s) {
  if (meter_ && meter_->work(slice_s, wait_s)) end_meter();
}

// Halves the divisor while the cheapest rung keeps the budget, then measures all rungs.
void Pace::end_meter() {
  const std::vector<render::Rung> rungs = std::exchange(meter_, nullptr)->take();
  const render::GovernorOptions& options = shown_->options;
  if (!seeks_size_) {
    governor_.emplace(rungs, options);
    spdlog::info("{}", render::describe_start(*governor_, options));
    return;
  }
  const bool fits = rungs.front().ms <= options.fill * options.budget_ms;
  if (fits && divisor_ > 1)
    start_meter(divisor_ / 2, true);
  else
    start_meter(fits ? divisor_ : std::min(2 * divisor_, coarsest), false);
}

void Pace::stop() {
  if (meter_) meter_->stop();
}

void Pace::observe(double ms) {
  ++frames_;
  if (ms <= shown_->options.budget_ms) ++within_;
  const std::size_t decided = governor_->decisions().size();
  governor_->observe(ms);
  if (governor_->decisions().size() > decided)
    spdlog::info("{}", render::describe(*governor_, governor_->decisions().back()));
}

std::string Pace::describe() const {
  if (meter_)
    return seeks_size_
               ? "measuring sizes of frames"
               : fmt::format("measuring settings, {} of {}", meter_->measured(), meter_->count());
  if (!governor_) return "";
  const std::string rung = governor_->rungs()[governor_->rung()].name();
  if (!(shown_->options.budget_ms > 0) || frames_ == 0) return rung;
  return fmt::format("{}; {:.1f} % of {} frames within", rung,
                     100 * double(within_) / double(frames_), frames_);
}

}  // namespace nightcity::viewer
