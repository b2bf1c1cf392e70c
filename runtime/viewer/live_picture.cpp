#include "runtime/viewer/live_picture.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>

#include "runtime/render/pass_constants.h"
#include "runtime/scene/markers.h"
#include "runtime/viewer/camera_motion.h"
#include "runtime/viewer/comparison.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity::viewer {
namespace {

// A slice of a frame: well below the 50 ms after which a hand notices, and long enough that the
// cost of submitting does not count.
constexpr double slice_s = 0.025;

// A first look: the reservoirs of the coarser picture make up for the rest.
// Each finer picture has new cells of the irradiance cache, which begin with what the coarser one's
// knew: one path each, and a fourth of the cells, are enough until the view rests.
constexpr render::Effort quick_effort{
    .max_candidates = 8, .max_neighbours = 0, .max_cell_paths = 1, .cell_scale = 2};

// The first picture while most passes are still being compiled.
constexpr render::Effort draft_effort{.max_candidates = 4, .max_neighbours = 0, .draft = true};

// While the clock runs, the picture is the mean of the last few frames and follows motion.
constexpr std::uint32_t frames_in_motion = 8;

constexpr std::size_t metered_pixels = 20'000;

// Returns whether a picture of one view is a picture of the other.
bool same_view(const View& a, const View& b) {
  return is_same_pose(a.pose, b.pose) && a.window == b.window && a.divisor == b.divisor &&
         a.settings.time_s == b.settings.time_s &&
         a.settings.averaging.accumulate == b.settings.averaging.accumulate &&
         render::have_same_estimate(a.settings, b.settings);
}

bool same_display(const render::DisplaySettings& a, const render::DisplaySettings& b) {
  render::DisplaySettings other = b;
  other.denoise = a.denoise;  // only rendering shows it
  return a == other;
}

PaceOf pace_of(const View& view) {
  return {view.governor, view.settings, view.window, view.divisor, view.pose};
}

// Returns what a frame leaves of it: the picture, without what an eye or a camera adds.
render::DisplaySettings left_by_a_frame(const render::DisplaySettings& display) {
  render::DisplaySettings left;
  left.denoise = display.denoise;
  left.ev100 = display.ev100;
  left.tone = display.tone;
  left.view_lowest = display.view_lowest;
  left.view_highest = display.view_highest;
  return left;
}

// Returns whether pictures begin with a draft. A GPU's driver has most passes on disk.
bool has_drafts(const gpu::Device& device, const render::RenderSettings& settings) {
  return device.info().kind == "cpu" && render::traits_of(settings.sampling.estimator).samples;
}

void log_frame(const render::Renderer& renderer, const char* name) {
  if (!spdlog::should_log(spdlog::level::debug)) return;
  std::string passes;
  for (const gpu::Timer::Span& pass : renderer.timings())
    passes += fmt::format(", {} {:.1f}", pass.name, pass.ms);
  spdlog::debug("{} of {} x {}: {:.1f} ms{}", name, renderer.width(), renderer.height(),
                1000 * renderer.frame_s(), passes);
}

double pixels_of(glm::uvec2 size) {
  return double(size.x) * size.y;
}

}  // namespace

void start_first_passes(render::PassLibrary& passes, const render::RenderSettings& settings,
                        const scene::SceneTraits& traits) {
  const render::PassConstants whole = render::find_constants(settings, traits);
  if (passes.has(whole)) return;
  if (!has_drafts(passes.device(), settings)) {
    passes.is_ready(whole);
    return;
  }
  passes.is_ready(render::find_constants(render::to_draft(settings), traits),
                  render::Extent::draft);
}

LivePicture::LivePicture(gpu::Device& device, render::PassLibrary& passes,
                         render::DeviceScene& scene, glm::uvec2 window)
    : device_(device),
      renderer_(device, passes, scene, std::max(1u, window.x / Refinement::coarsest),
                std::max(1u, window.y / Refinement::coarsest)),
      pace_(device, passes, scene) {}

void LivePicture::notice_changes(const View& view, double now_s) {
  refinement_.set_divisor(view.divisor);
  if (view_) {
    const bool same = same_view(view, *view_);
    if (!same) refinement_.change(now_s);
    const bool denoised = view.settings.display.denoise != view_->settings.display.denoise;
    display_changed_ |= denoised;
    // A governed frame takes as long as its budget or its error asks for: that was measured, and
    // what coarser frames took says less.
    const bool slow =
        !is_governed_ && refinement_.is_worth_giving_up(plan_, pixels_of(view.window));
    if ((!same && slow) || denoised) renderer_.abandon_frame();
  }
  view_ = view;
}

bool LivePicture::find_passes(const View& view) {
  const bool is_first = !has_picture();
  // The processor that would compile the other passes meanwhile renders the draft.
  const bool ready =
      is_first ? renderer_.has_passes(view.settings) : renderer_.is_ready(view.settings);
  drafts_ = !ready && (is_first || is_draft()) && has_drafts(device_, view.settings);
  if (!drafts_) return ready || renderer_.is_ready(view.settings);
  const bool is_shown = !is_first && shown_ && same_view(*shown_, view);
  return !is_shown && renderer_.is_draft_ready(view.settings);
}

void LivePicture::begin(const View& view, double now_s) {
  plan_ = refinement_.plan(now_s, pixels_of(view.window), view.runs);
  moves_ = view.runs || refinement_.is_moving(now_s);
  is_governed_ = !drafts_ && pace_.governs() && moves_;
  if (is_governed_) plan_ = {pace_.divisor(), true};
  effort_ = drafts_        ? draft_effort
            : is_governed_ ? pace_.effort()
            : plan_.quick  ? quick_effort
                           : render::Effort{};
  const glm::uvec2 size = glm::max(view.window / plan_.divisor, glm::uvec2(1));
  renderer_.set_size(size.x, size.y);
  render::RenderSettings settings = view.settings;
  // Light by where it comes from has no mean that follows motion: each frame then stands alone.
  settings.averaging.window = view.runs && !settings.sampling.layers ? frames_in_motion : 0;
  // At an edge, an offset within the pixel shows another surface in every frame, and each would
  // begin a mean of its own: thin things would crawl as dashes.
  if (view.runs) settings.sampling.jitter = false;
  begun_ = view;
  renderer_.begin_frame(view.pose, settings, effort_);
}

bool LivePicture::rests(const View& view, double now_s) const {
  return !view.runs && !view.switches && !display_changed_ && !renderer_.has_begun() &&
         refinement_.is_fine() && renderer_.frames() >= view.max_frames && view_ &&
         pace_.is_settled(pace_of(view)) && same_view(view, *view_) &&
         view.settings.display.denoise == view_->settings.display.denoise &&
         refinement_.plan(now_s, pixels_of(view.window), false) == shown_plan_;
}

bool LivePicture::shows(const View& view) const {
  return shown_ && !is_draft() && same_view(*shown_, view);
}

bool LivePicture::work(const View& view, double now_s, double wait_s) {
  if (!wait(wait_s)) return false;
  if (!renderer_.is_complete()) {
    notice_changes(view, now_s);
    // There is a picture before anything is measured.
    if (has_picture() && !renderer_.has_begun()) pace_.set(pace_of(view));
    if (pace_.is_measuring() && !renderer_.has_begun()) {
      compiles_ = !renderer_.is_ready(view.settings);
      if (!compiles_) pace_.measure(slice_s, wait_s);
      return false;
    }
    if (!renderer_.has_begun()) {
      if (rests(view, now_s)) return false;
      compiles_ = !find_passes(view);
      if (compiles_) return false;
      begin(view, now_s);
    }
  }
  if (!renderer_.continue_frame(slice_s, wait_s)) return false;
  complete(view);
  return true;
}

void LivePicture::complete(const View& view) {
  ++completed_;
  log_frame(renderer_, effort_.draft ? "draft" : plan_.quick ? "quick frame" : "frame");
  if (is_governed_) {
    const double ms = gpu::sum_ms(renderer_.timings());
    pace_.observe(ms > 0 ? ms : 1000 * renderer_.frame_s());
  }
  const glm::dvec2 size(
      renderer_.picture_size());  // what is left out of it by a scale takes no time
  // A draft says little of the next frame's time, and the coarsest picture comes after it.
  if (!effort_.draft)
    refinement_.complete(plan_, size.x * size.y, renderer_.frame_s(), same_view(begun_, view));
  shown_plan_ = plan_;
  shown_moves_ = moves_;
  shown_effort_ = effort_;
  shown_ = begun_;
  shown_display_ = left_by_a_frame(begun_.settings.display);
  display_changed_ =
      display_changed_ && begun_.settings.display.denoise != view.settings.display.denoise;
}

render::RenderSettings LivePicture::made_with() const {
  render::RenderSettings settings = shown_ ? shown_->settings : render::RenderSettings{};
  settings.sampling.candidates =
      std::min(settings.sampling.candidates, shown_effort_.max_candidates);
  settings.reuse.neighbours = std::min(settings.reuse.neighbours, shown_effort_.max_neighbours);
  return is_draft() ? render::to_draft(settings) : settings;
}

bool LivePicture::is_like(const LivePicture& other) const {
  return shown_ && other.shown_ && has_picture() && other.has_picture() && !is_draft() &&
         !other.is_draft() && is_same_pose(shown_->pose, other.shown_->pose) &&
         shown_->window == other.shown_->window &&
         have_same_lights(shown_->settings, other.shown_->settings) &&
         shown_->settings.indirect.bounces == other.shown_->settings.indirect.bounces &&
         shown_->settings.environment == other.shown_->settings.environment &&
         shown_->settings.air == other.shown_->settings.air;
}

void LivePicture::expose(const render::DisplaySettings& display, const LivePicture* reference) {
  if (reference && !is_like(*reference)) reference = nullptr;
  const std::uint64_t compared_with = reference ? reference->completed_ : 0;
  if (!has_picture() || (same_display(display, shown_display_) && compared_with == compared_with_))
    return;
  renderer_.expose(display, reference ? &reference->renderer_ : nullptr);
  shown_display_ = display;
  compared_with_ = compared_with;
}

std::optional<double> LivePicture::luminance_at(const glm::vec3& point) const {
  if (!shown_ || !has_picture()) return std::nullopt;
  const glm::vec2 window(shown_->window), size(renderer_.width(), renderer_.height());
  const gpu::Camera camera = scene::make_camera(shown_->pose, window.x / window.y);
  const auto at = scene::project(camera, point);
  if (!at || at->x < 0 || at->y < 0 || at->x >= 1 || at->y >= 1) return std::nullopt;
  const glm::vec3 mean = renderer_.mean_at(glm::uvec2(glm::vec2(*at) * size));
  return double(tonemap::luminance_709(mean.r, mean.g, mean.b));
}

Metered LivePicture::meter() const {
  return meter_picture(renderer_.sample_mean(metered_pixels));
}

}  // namespace nightcity::viewer
