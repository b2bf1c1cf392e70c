// The course of a frame: what it starts from, its slices, and what it leaves for the next.
#include "runtime/render/renderer.h"

#include <algorithm>
#include <cmath>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/limits.h"
#include "runtime/render/frame_steps.h"
#include "runtime/render/frame_values.h"
#include "runtime/render/pass_constants.h"
#include "runtime/render/setting_table.h"

namespace nightcity::render {
namespace {

bool same_view(const scene::CameraPose& a, const scene::CameraPose& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg;
}

// Returns the same shape with sides that are a share of these, of at least a pixel.
glm::uvec2 scale_size(glm::uvec2 size, float share) {
  const auto scaled = [share](std::uint32_t side) {
    return std::clamp(static_cast<std::uint32_t>(std::lround(double{share} * side)), 1u, side);
  };
  return {scaled(size.x), scaled(size.y)};
}

}  // namespace

Renderer::Renderer(gpu::Device& device, PassLibrary& passes, DeviceScene& scene,
                   std::uint32_t width, std::uint32_t height)
    : device_(device),
      library_(passes),
      scene_(scene),
      vehicle_passes_(device, scene),
      cache_(device),
      display_(device, passes),
      run_(device) {
  set_size(width, height);
  frame_ = gpu::Buffer(device, sizeof(gpu::Frame), gpu::Memory::host);
  exposed_frame_ = gpu::Buffer(device, sizeof(gpu::Frame), gpu::Memory::host);
  for (PictureBuffers& picture : pictures_) picture.set_size(device, size_);
}

void Renderer::set_size(std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0 || width > measure::max_image_side ||
      height > measure::max_image_side)
    throw UsageError("--size", "a picture has 1 to " + std::to_string(measure::max_image_side) +
                                   " pixels a side");
  picture_size_ = size_ = {width, height};
}

void Renderer::check(const RenderSettings& settings) const {
  check_settings(settings);
  if (settings.display.glare_age > 0 && settings.projection != PROJECTION_PERSPECTIVE)
    throw UsageError("--glare", "is shown in perspective pictures alone");
  if (settings.environment.glow != SkyGlow::none && !scene_.has_sky_map())
    throw UsageError("--sky",
                     "auto and overcast are made when a scene is loaded, and this one was "
                     "loaded with another sky");
  const float share = settings.sampling.vehicle_share;
  if (scene_.has_traffic() && !(share > 0 && share < 1))
    throw UsageError("--vehicle-share",
                     "must lie above 0 and below 1: vehicles' lights and static lights each need a "
                     "share");
}

void Renderer::restart_if_changed() {
  const RenderSettings& settings = next_.settings;
  const RenderSettings& before = done_.settings;
  const bool same_settings = have_same_estimate(settings, before);
  scene_.set_time(settings.time_s, settings.environment.lights);
  next_.light_changes = scene_.light_changes();
  const std::uint32_t switched = next_.light_changes - done_.light_changes;
  const bool moved = scene_.has_traffic() && settings.time_s != before.time_s;
  // A mean of all frames ends where anything moves; a mean of the last few follows the motion.
  const bool still = done_.pose && same_view(*next_.pose, *done_.pose) && switched == 0 && !moved;
  const AveragingSettings& averaging = settings.averaging;
  if (!same_settings || !averaging.accumulate || averaging.window != before.averaging.window ||
      size_ != pictures_[parity_].size || next_.effort != done_.effort ||
      (averaging.window == 0 && !still))
    next_.frames = 0;
  // Reservoirs of other settings estimate something else; those of another view are reprojected.
  // The scene keeps the switches of one change before, and no older ones.
  if (!same_settings || switched > 1 || done_.effort.draft || next_.effort.draft)
    next_.has_history = false;
  // Cells forget while the clock moves. Lights that change while it stands (their tables took a
  // moment, or a user switched them) would stay in settled cells.
  const bool stands = settings.time_s == before.time_s;
  if (!same_settings || switched > 1 || (switched > 0 && stands)) cache_.clear();
  moved_s_ =
      scene_.has_traffic() || scene_.has_switches() ? std::abs(settings.time_s - before.time_s) : 0;
}

void Renderer::begin_frame(const scene::CameraPose& pose, const RenderSettings& asked,
                           const Effort& effort) {
  abandon_frame();
  const RenderSettings settings = effort.draft ? to_draft(asked) : asked;
  check(settings);
  next_ = done_;
  next_.pose = scene::relative_to(scene_.origin(), pose);
  next_.settings = settings;
  next_.effort = effort;
  size_ = scale_size(picture_size_, settings.sampling.resolution_scale * effort.resolution_scale);
  restart_if_changed();
  if (!next_.has_history) {
    next_.age = 0;
    next_.step_cd_m2 = 0;
  }
  passes_ = library_.get(find_constants(settings, scene_.traits()),
                         effort.draft ? Extent::draft : Extent::whole);

  RenderSettings bounded = settings;
  bounded.sampling.candidates = std::min(settings.sampling.candidates, effort.max_candidates);
  bounded.reuse.neighbours = std::min(settings.reuse.neighbours, effort.max_neighbours);
  bounded.sampling.half_rate = settings.sampling.half_rate || effort.half_rate;
  gpu::Frame frame{};
  fill_buffers(frame, bounded);
  fill_view(frame);
  fill_sampling(frame, bounded, next_.step_cd_m2);
  frame_.upload(&frame, sizeof(frame));
  next_.lit = frame.scene.lit;
  run_.start(list_steps({.passes = *passes_,
                         .cache = cache_,
                         .vehicles = vehicle_passes_,
                         .frame_address = frame_.address(),
                         .size = size_,
                         .has_history = next_.has_history,
                         .lights = frame.scene.light_count,
                         .slices = frame.slices,
                         .reservoirs = reservoirs_.handle(),
                         .spatial = pictures_[parity_ ^ 1].spatial.handle(),
                         .radiance = radiance_.handle(),
                         .denoised = denoised_.handle()},
                        bounded));
  if (!effort.draft) ++frame_number_;
  begun_ = true;
}

bool Renderer::continue_frame(double slice_s, double wait_s) {
  if (!begun_) return true;
  if (run_.wait(0) && !run_.is_done()) run_.submit(slice_s);
  run_.wait(wait_s);
  if (!run_.is_done()) return false;
  finish_frame();
  return true;
}

void Renderer::finish_frame() {
  begun_ = false;
  done_ = next_;
  parity_ ^= 1;
  timings_ = run_.timings();
  frame_s_ = run_.busy_s();
  const RenderSettings& settings = done_.settings;
  if (traits_of(settings.sampling.estimator).samples) done_.has_history = true;
  ++done_.frames;
  if (settings.averaging.window > 0)
    done_.frames = std::min(done_.frames, settings.averaging.window);
  meter_faint();
}

void Renderer::meter_faint() {
  constexpr std::uint32_t frames_between = 32;
  constexpr std::size_t metered_pixels = 5'000;
  const SamplingSettings& sampling = done_.settings.sampling;
  if (done_.age++ % frames_between != 0) return;
  if (!traits_of(sampling.estimator).reuses || sampling.roulette_steps <= 0) return;
  done_.step_cd_m2 = measure::find_first_step(sample_mean(metered_pixels));
}

void Renderer::abandon_frame() {
  if (!begun_) return;
  run_.wait(std::numeric_limits<double>::infinity());
  if (run_.is_done()) {  // it is complete: nothing is given up
    finish_frame();
    return;
  }
  run_.stop();
  begun_ = false;
  vehicle_passes_.leave();
  // A frame adds to the cache and to the layers in place: given up half-way, it leaves them neither
  // as they were nor a mean of whole frames.
  cache_.clear();
  if (next_.settings.sampling.layers) done_.pose.reset();
}

void Renderer::render_frame(const scene::CameraPose& pose, const RenderSettings& settings) {
  constexpr double whole = std::numeric_limits<double>::infinity();
  begin_frame(pose, settings);
  while (!continue_frame(whole, whole)) {
  }
}

}  // namespace nightcity::render
