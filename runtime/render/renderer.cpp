#include "runtime/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/limits.h"
#include "runtime/measure/upscale.h"
#include "runtime/render/frame_steps.h"
#include "runtime/render/frame_values.h"
#include "runtime/render/image_layers.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/pass_constants.h"
#include "runtime/render/picture_download.h"
#include "runtime/render/setting_table.h"
#include "runtime/render/settings_file.h"

namespace nightcity::render {
namespace {

bool same_view(const scene::CameraPose& a, const scene::CameraPose& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg;
}

// Returns whether a frame of these settings has what a view other than the picture shows.
bool shows(const RenderSettings& settings, std::uint32_t view, bool has_reference) {
  return view != VIEW_PICTURE && (settings.sampling.layers || !needs_layers(view)) &&
         (settings.sampling.hits || !needs_hits(view)) &&
         (has_reference || view != VIEW_DIFFERENCE);
}

// Returns the angle of a pixel in the middle of a perspective picture, rad.
double pixel_angle(const gpu::Camera& camera, glm::uvec2 size) {
  return 2 * double{camera.tan_half_height} / size.y;
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

void Renderer::fill_buffers(gpu::Frame& frame, const RenderSettings& settings) {
  if (has_air(settings)) scene_.need_light_tree();
  const PictureBuffers& before = pictures_[parity_];
  PictureBuffers& now = pictures_[parity_ ^ 1];
  now.set_size(device_, size_);
  const std::size_t pixels = now.pixels();
  const auto reserve = [&](gpu::Buffer& buffer, std::size_t bytes) {
    fit(device_, buffer, bytes);
    return buffer.address();
  };
  frame.scene = scene_.buffers();
  for (float& share : frame.scene.traffic.cycle.density) share *= settings.environment.traffic;
  frame.previous_lit = next_.has_history ? done_.lit : frame.scene.lit;
  vehicle_passes_.enter(frame);
  frame.surfaces = now.surfaces.address();
  frame.previous_surfaces = before.surfaces.address();
  frame.keeps_hits = settings.sampling.hits;
  if (settings.sampling.hits) frame.hits = reserve(now.hits, 2 * pixels * sizeof(std::uint32_t));
  frame.reservoirs = reserve(reservoirs_, pixels * sizeof(gpu::Reservoir));
  frame.spatial = now.spatial.address();
  frame.previous_reservoirs = before.spatial.address();
  frame.blocks = now.pixel_blocks.address();
  frame.previous_blocks = before.pixel_blocks.address();
  frame.slices = choose_reference_slices(settings, size_, frame.scene.light_count,
                                         device_.info().kind == "cpu");
  frame.radiance = reserve(radiance_, frame.slices * pixels * sizeof(gpu::Accumulation));
  frame.accumulation = now.accumulation.address();
  frame.previous_accumulation = before.accumulation.address();
  if (settings.sampling.layers) reserve(layers_, pixels * sizeof(gpu::LayerSums));
  frame.layers = layers_.address();
  if (settings.display.denoise) {
    for (int i = 0; i < 2; ++i)
      frame.denoise[i] = reserve(denoise_[i], pixels * sizeof(gpu::Demodulated));
    reserve(denoised_, pixels * sizeof(gpu::Accumulation));
  }
  frame.display = now.display.address();
  if (traits_of(settings.sampling.estimator).pairs) {
    const std::size_t pairings = pairings_of(settings.reuse);
    frame.pair_partners = reserve(pair_partners_, pairings * pixels * sizeof(std::uint32_t));
    frame.pair_targets = reserve(pair_targets_, (1 + pairings) * pixels * sizeof(float));
  }
  if (!traits_of(settings.sampling.estimator).samples && settings.indirect.bounces > 0)
    frame.path = reserve(path_, pixels * sizeof(gpu::PathVertex));
  if (settings.count_rays) {
    if (ray_count_.bytes() == 0)
      ray_count_ = gpu::Buffer(device_, sizeof(std::uint32_t), gpu::Memory::host);
    constexpr std::uint32_t none = 0;
    ray_count_.upload(&none, sizeof none);
    frame.ray_count = ray_count_.address();
  }
}

void Renderer::fill_view(gpu::Frame& frame) {
  const RenderSettings& settings = next_.settings;
  frame.previous_camera = done_.camera;
  next_.camera = scene::make_camera(*next_.pose, float(size_.x) / float(size_.y));
  next_.camera.projection = settings.projection;
  if (settings.projection == PROJECTION_EQUIRECTANGULAR) level_camera(next_.camera);
  frame.camera = next_.camera;
  frame.size = size_;
  frame.previous_size = pictures_[parity_].size;
  frame.frame = frame_number_;
  const double before_s = next_.has_history ? done_.settings.time_s : settings.time_s;
  frame.time_s = float(settings.time_s);
  frame.previous_time_s = float(before_s);
  frame.cycle_time_s = cycle_time(frame.scene.traffic.cycle, settings.time_s);
  frame.previous_cycle_time_s = cycle_time(frame.scene.traffic.cycle, before_s);
  frame.has_history = next_.has_history;
  // By frames in the mean, not by frame number: every estimator then gets the same sub-pixels.
  const std::uint32_t sub_pixel = settings.averaging.window == 0 ? next_.frames : frame_number_;
  const glm::vec2 jitter = settings.sampling.jitter ? find_sub_pixel(sub_pixel) : glm::vec2(0.5f);
  frame.jitter_x = jitter.x;
  frame.jitter_y = jitter.y;
  frame.reset = next_.frames == 0;
  frame.window = settings.averaging.accumulate ? settings.averaging.window : 0;
  fill_display(frame, settings.display);
  frame.bounces = settings.indirect.bounces;
  frame.reference_paths = reference_paths(frame.scene.light_count);
  if (find_indirect(settings) == INDIRECT_CACHE) {
    IndirectSettings indirect = settings.indirect;
    indirect.cell_px *= next_.effort.cell_scale;
    cache_.enter(frame, indirect, moved_s_, next_.effort.max_cell_paths);
  }
  if (has_air(settings)) {
    const bool is_empty = scene_.bounds().empty();
    frame.air = next_.air = make_air(settings.air, is_empty ? 0 : scene_.bounds().lower.y);
  }
  frame.wetness = settings.environment.wetness;
  const glm::vec3& sky = settings.environment.sky_cd_m2;
  frame.sky = sky * scene_.sky_now().factor;
  frame.sky_base = sky * scene_.sky_now().base;
  frame.moon_direction = settings.environment.moon_direction;
  frame.moon_lux = settings.environment.moon_lux;
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

void Renderer::inspect(gpu::Frame& frame, const DisplaySettings& display,
                       const Renderer* reference) {
  const PictureBuffers& picture = pictures_[parity_];
  const RenderSettings& settings = done_.settings;
  fill_display(frame, display);
  frame.scene = scene_.buffers();
  frame.surfaces = picture.surfaces.address();
  frame.hits = picture.hits.address();
  frame.camera = done_.camera;
  frame.spatial = picture.spatial.address();
  frame.layers = layers_.address();
  frame.candidates =
      traits_of(settings.sampling.estimator).samples ? settings.sampling.candidates : 0;
  if (reference) {
    const PictureBuffers& other = reference->pictures_[reference->parity_];
    frame.reference = other.accumulation.address();
    frame.reference_size = other.size;
  }
  exposed_frame_.upload(&frame, sizeof(frame));
  const gpu::Push push{exposed_frame_.address(), 0, 0};
  device_.run([&](VkCommandBuffer commands) {
    passes_->inspect.dispatch(commands, &push, frame.size.x, frame.size.y);
    gpu::full_barrier(commands);
  });
}

void Renderer::expose(const DisplaySettings& display, const Renderer* reference) {
  if (done_.frames == 0 || !passes_) return;
  if (reference && reference->frames() == 0) reference = nullptr;
  const PictureBuffers& picture = pictures_[parity_];
  gpu::Frame frame{};
  frame.size = picture.size;
  frame.display = picture.display.address();
  frame.accumulation =
      done_.settings.display.denoise ? denoised_.address() : picture.accumulation.address();
  if (!done_.effort.draft && shows(done_.settings, display.view, reference != nullptr))
    inspect(frame, display, reference);
  else
    display_.show(frame, display, pixel_angle(done_.camera, picture.size));
  const bool denoise = done_.settings.display.denoise;
  done_.settings.display = display;
  done_.settings.display.denoise = denoise;
}

measure::Image8 Renderer::develop(const measure::Image& image, const DisplaySettings& display) {
  return display_.develop(image, display, pixel_angle(done_.camera, {image.width, image.height}));
}

std::uint64_t Renderer::shadow_rays() const {
  return done_.settings.count_rays ? ray_count_.read<std::uint32_t>(1)[0] : 0;
}

measure::ImageInfo Renderer::describe_picture() const {
  const PictureBuffers& picture = pictures_[parity_];
  const RenderSettings& settings = done_.settings;
  measure::ImageInfo info;
  info.estimator = std::string(name_of(settings.sampling.estimator)) +
                   (settings.display.denoise ? ", denoised" : "");
  info.frames = done_.frames;
  info.candidates =
      traits_of(settings.sampling.estimator).samples ? settings.sampling.candidates : 0;
  info.neighbours = settings.reuse.neighbours;
  info.bounces = settings.indirect.bounces;
  info.indirect = describe_indirect(settings, scene_.buffers().light_count);
  info.left_out = name_parts(scene_.left_out());
  info.settings = describe_changes(settings);
  if (scene_.has_edited_lights())
    info.settings += info.settings.empty() ? "edited lights" : ", edited lights";
  info.seed = settings.sampling.seed;
  info.ev100 = settings.display.ev100;
  info.device = device_.label();
  if (is_scaled())
    info.estimator += ", upscaled from " + std::to_string(picture.size.x) + " x " +
                      std::to_string(picture.size.y);
  RenderSettings as_done = settings;
  as_done.sampling.half_rate |= done_.effort.half_rate;
  if (is_half_rate(as_done))
    info.estimator += ", " + describe_half_rate(settings.averaging, done_.frames);
  return info;
}

measure::Image Renderer::download(bool layers) const {
  const PictureBuffers& picture = pictures_[parity_];
  const RenderSettings& settings = done_.settings;
  const std::size_t pixels = picture.pixels();
  const gpu::Buffer& source = settings.display.denoise ? denoised_ : picture.accumulation;
  const auto sums = source.read<gpu::Accumulation>(pixels);
  measure::Image image = make_picture(sums, picture.size);
  image.info = describe_picture();
  if (!layers && is_scaled()) return measure::upscale(image, picture_size_.x, picture_size_.y);
  if (!layers) return image;
  add_luminance_layer(image);
  // Layers are sums over the frames of the mean; a window has no such sum.
  if (settings.sampling.layers && settings.averaging.window == 0)
    add_light_layers(image, layers_.read<gpu::LayerSums>(pixels), done_.frames);
  const auto surfaces = picture.surfaces.read<gpu::Surface>(pixels);
  add_surface_layers(image, surfaces, scene_);
  if (settings.air.visibility_km > 0)
    add_transmittance_layer(image, surfaces, done_.air, done_.camera.position.y);
  if (is_scaled()) return measure::upscale(image, picture_size_.x, picture_size_.y);
  return image;
}

measure::Image Renderer::sample_mean(std::size_t pixels) const {
  return sample_picture(device_, pictures_[parity_], pixels);
}

glm::vec3 Renderer::mean_at(glm::uvec2 pixel) const {
  const PictureBuffers& picture = pictures_[parity_];
  gpu::Accumulation sum{};
  picture.accumulation.download(&sum, sizeof sum,
                                (std::size_t{pixel.y} * picture.size.x + pixel.x) * sizeof sum);
  return mean_of(sum);
}

}  // namespace nightcity::render
