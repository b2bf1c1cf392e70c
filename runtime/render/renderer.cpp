#include "runtime/render/renderer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/limits.h"
#include "runtime/measure/upscale.h"
#include "runtime/render/image_layers.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/setting_table.h"
#include "runtime/render/settings_file.h"

namespace nightcity::render {
namespace {

// Invocations that fill the largest devices twice, and the most slices that the reference works at
// together.
constexpr std::size_t busy_invocations = std::size_t{1} << 19;
constexpr std::size_t max_slices = 32;

// Partners of a pixel in one frame at most: those without history may have more than the others.
std::uint32_t pairings_of(const ReuseSettings& reuse) {
  return reuse.max_history > 0 ? std::max(reuse.neighbours, reuse.disocclusion_boost)
                               : reuse.neighbours;
}

// The shortest falloff of the history: 1 / falloff^2 of shorter ones would overflow.
constexpr float min_history_falloff_m = 0.001f;

// The thinnest layer of air, for the same reason.
constexpr float min_air_height_m = 0.001f;

constexpr std::uint32_t chunks_of(std::uint32_t lights) {
  return lights / REFERENCE_CHUNK + (lights % REFERENCE_CHUNK != 0);
}

// Paths that the reference follows from a pixel in a frame: shaders/limits.h.
std::uint32_t reference_paths(std::uint32_t lights) {
  return lights <= REFERENCE_CHUNK ? REFERENCE_PATHS : REFERENCE_PICK_PATHS;
}

bool same_view(const scene::CameraPose& a, const scene::CameraPose& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg;
}

// Returns whether passes have air compiled in, which they may without need: see forced_features.
bool has_air(const RenderSettings& settings) {
  return settings.air.visibility_km > 0 || (settings.forced_features >> CONSTANT_AIR & 1u) != 0;
}

glm::vec3 mean_of(const gpu::Accumulation& sum) {
  return sum.frames > 0 ? (sum.sum - sum.compensation) / sum.frames : glm::vec3(0);
}

// Returns whether a frame of these settings has what a view other than the picture shows.
bool shows(const RenderSettings& settings, std::uint32_t view) {
  return view != VIEW_PICTURE && (settings.sampling.layers || !needs_layers(view));
}

// Turns a camera to the horizon: viewers of panoramas take their middle row for it.
void level(gpu::Camera& camera) {
  glm::vec3 ahead = camera.forward;
  if (std::abs(ahead.y) > 0.999f) ahead = camera.up;
  camera.forward = glm::normalize(glm::vec3(ahead.x, 0, ahead.z));
  camera.up = {0, 1, 0};
  camera.right = glm::cross(camera.forward, camera.up);
}

// Returns the angle of a pixel in the middle of a perspective picture, rad.
double pixel_angle(const gpu::Camera& camera, glm::uvec2 size) {
  return 2 * double{camera.tan_half_height} / size.y;
}

// Sub-pixel positions: the R2 sequence (Roberts 2018), starting at the pixel's centre.
float radical(double step, std::uint32_t frame) {
  const double x = 0.5 + step * double(frame);
  return static_cast<float>(std::min(x - std::floor(x), 0.99999994));
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

PassConstants Renderer::constants_of(const RenderSettings& settings) const {
  PassConstants constants{};
  constants[CONSTANT_ESTIMATOR] = static_cast<std::uint32_t>(settings.sampling.estimator);
  constants[CONSTANT_PROFILES] = scene_.has_profiles();
  constants[CONSTANT_RECTANGLES] = scene_.has_rectangles();
  constants[CONSTANT_VISIBILITY_REUSE] = settings.reuse.visibility_reuse;
  const bool sky = settings.environment.sky_cd_m2 != glm::vec3(0),
             moon = settings.environment.moon_lux != glm::vec3(0);
  constants[CONSTANT_SKY] = sky && scene_.has_sky_map() ? SKY_MAP
                            : sky || moon               ? SKY_UNIFORM
                                                        : SKY_DARK;
  constants[CONSTANT_GLOSS] = settings.environment.wetness > 0 || scene_.has_water();
  constants[CONSTANT_LAYERS] = settings.sampling.layers;
  constants[CONSTANT_SCHEDULES] =
      scene_.has_switches() || settings.environment.lights != scene::all_families;
  constants[CONSTANT_TRAFFIC] = scene_.has_traffic();
  constants[CONSTANT_COUNT_RAYS] = settings.count_rays;
  constants[CONSTANT_INDIRECT] = find_indirect(settings);
  constants[CONSTANT_AIR] = !has_air(settings)          ? AIR_CLEAR
                            : settings.air.height_m > 0 ? AIR_LAYERED
                                                        : AIR_EVEN;
  constants[CONSTANT_PROJECTION] = settings.projection;
  for (const Feature& feature : optional_features())
    if ((settings.forced_features >> feature.constant & 1u) != 0 &&
        constants[feature.constant] == 0)
      constants[feature.constant] = 1;
  return constants;
}

std::vector<Feature> Renderer::list_unneeded(const RenderSettings& settings) const {
  const PassConstants constants = constants_of(settings);
  std::vector<Feature> features;
  for (const Feature& feature : optional_features())
    if (constants[feature.constant] == 0) features.push_back(feature);
  return features;
}

template <class Pass>
FrameStep Renderer::step_over(glm::uvec2 grid, const Pass& pass, const char* name,
                              std::uint32_t first, std::uint32_t count,
                              std::uint32_t slices) const {
  const gpu::Push push{frame_.address(), first, count};
  return {name, pass.count_groups(grid.x, grid.y),
          [&pass, push, grid, slices](VkCommandBuffer commands, std::uint32_t part,
                                      std::uint32_t parts) {
            pass.dispatch_groups(commands, &push, grid.x, grid.y, part, parts, slices);
          }};
}

template <class Pass>
FrameStep Renderer::step_of(const Pass& pass, const char* name, std::uint32_t first,
                            std::uint32_t count, std::uint32_t slices) const {
  return step_over(size_, pass, name, first, count, slices);
}

void Renderer::add_restir(std::vector<FrameStep>& steps, const RenderSettings& settings) const {
  // At half rate the pixels of a frame lie side by side in the left half of the grid, those that
  // may have to be filled in the right half: half_rate.glsl.
  const bool half_rate = is_half_rate(settings);
  const glm::uvec2 half{(size_.x + 1) / 2, size_.y}, sampled = half_rate ? half : size_,
                                                     any{half_rate ? 2 * half.x : size_.x, size_.y};
  steps.push_back(step_over(any, passes_->candidates, "candidates"));
  const EstimatorTraits& traits = traits_of(settings.sampling.estimator);
  if (traits.reuses && settings.reuse.max_history > 0 && next_.has_history)
    steps.push_back(step_over(sampled, passes_->temporal, "temporal"));
  if (traits.reuses && settings.reuse.neighbours > 0) {
    if (traits.pairs) {
      steps.push_back(step_over(sampled, passes_->pair_targets, "spatial targets"));
      steps.push_back(step_over(sampled, passes_->pair_reuse, "spatial"));
    } else {
      steps.push_back(step_over(sampled, passes_->spatial, "spatial"));
    }
  } else {
    const VkBuffer from = reservoirs_.handle(), to = pictures_[parity_ ^ 1].spatial.handle();
    const VkBufferCopy all{0, 0, pictures_[parity_ ^ 1].pixels() * sizeof(gpu::Reservoir)};
    steps.push_back({"copy", 1, [=](VkCommandBuffer commands, auto, auto) {
                       vkCmdCopyBuffer(commands, from, to, 1, &all);
                     }});
  }
  if (find_indirect(settings) == INDIRECT_CACHE)
    for (FrameStep& step : cache_.list_steps(*passes_, frame_.address()))
      steps.push_back(std::move(step));
  steps.push_back(step_over(any, passes_->shade, "shade"));
  if (half_rate) steps.push_back(step_over(half, passes_->fill, "fill"));
  if (has_air(settings)) steps.push_back(step_of(passes_->air, "air"));
}

void Renderer::add_end(std::vector<FrameStep>& steps, const RenderSettings& settings) const {
  steps.push_back(step_of(passes_->accumulate, "accumulate"));
  if (!settings.display.denoise) return;
  steps.push_back(step_of(passes_->demodulate, "demodulate"));
  for (std::uint32_t level = 0; level < DENOISE_LEVELS; ++level)
    steps.push_back(step_of(passes_->denoise, "denoise", level));
  // The next frame writes `radiance` before it is complete.
  const VkBuffer from = radiance_.handle(), to = denoised_.handle();
  const VkBufferCopy all{0, 0, pictures_[parity_ ^ 1].pixels() * sizeof(gpu::Accumulation)};
  steps.push_back({"denoise", 1, [=](VkCommandBuffer commands, auto, auto) {
                     vkCmdCopyBuffer(commands, from, to, 1, &all);
                   }});
}

// A picture of few pixels leaves most of a GPU idle, so chunks of lights go into slices side by
// side. Layers exist once, so they allow one slice.
std::uint32_t Renderer::reference_slices(const RenderSettings& settings) const {
  if (traits_of(settings.sampling.estimator).samples || settings.sampling.layers) return 1;
  const std::size_t pixels = std::size_t{size_.x} * size_.y;
  const std::size_t chunks = chunks_of(scene_.buffers().light_count);
  return static_cast<std::uint32_t>(
      std::clamp(std::min(busy_invocations / pixels, chunks), std::size_t{1}, max_slices));
}

void Renderer::add_reference(std::vector<FrameStep>& steps, const RenderSettings& settings,
                             std::uint32_t slices) const {
  const std::uint32_t lights = scene_.buffers().light_count;
  const std::uint32_t lights_per_dispatch = REFERENCE_CHUNK * slices;
  std::uint32_t first = 0;
  do {  // without lights, one empty chunk writes the light that surfaces emit
    const std::uint32_t count = std::min(lights_per_dispatch, lights - first);
    steps.push_back(
        step_of(passes_->reference, "reference", first, count, std::max(chunks_of(count), 1u)));
    if (has_air(settings))
      for (std::uint32_t part = 0; part < std::min(count, REFERENCE_CHUNK); part += AIR_CHUNK)
        steps.push_back(step_of(passes_->reference_air, "reference air", first + part,
                                first + count, chunks_of(count)));
    first += lights_per_dispatch;
  } while (first < lights);
  if (settings.indirect.bounces == 0) return;
  for (std::uint32_t path = 0; path < reference_paths(lights); ++path)
    for (std::uint32_t bounce = 1; bounce <= settings.indirect.bounces; ++bounce)
      steps.push_back(step_of(passes_->reference_path, "reference paths", path, bounce));
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
  if (!same_settings || switched > 1) next_.has_history = false;
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
  frame.reservoirs = reserve(reservoirs_, pixels * sizeof(gpu::Reservoir));
  frame.spatial = now.spatial.address();
  frame.previous_reservoirs = before.spatial.address();
  frame.slices = reference_slices(settings);
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
  if (settings.projection == PROJECTION_EQUIRECTANGULAR) level(next_.camera);
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
  frame.jitter_x = settings.sampling.jitter ? radical(0.7548776662466927, sub_pixel) : 0.5f;
  frame.jitter_y = settings.sampling.jitter ? radical(0.5698402909980532, sub_pixel) : 0.5f;
  frame.reset = next_.frames == 0;
  frame.window = settings.averaging.accumulate ? settings.averaging.window : 0;
  fill_display(frame, settings.display);
  frame.bounces = settings.indirect.bounces;
  frame.reference_paths = reference_paths(frame.scene.light_count);
  if (find_indirect(settings) == INDIRECT_CACHE)
    cache_.enter(frame, settings.indirect, moved_s_, next_.effort.max_cell_paths);
  fill_air(frame, settings);
  frame.wetness = settings.environment.wetness;
  const glm::vec3& sky = settings.environment.sky_cd_m2;
  frame.sky = sky * scene_.sky_now().factor;
  frame.sky_base = sky * scene_.sky_now().base;
  frame.moon_direction = settings.environment.moon_direction;
  frame.moon_lux = settings.environment.moon_lux;
}

void Renderer::fill_air(gpu::Frame& frame, const RenderSettings& settings) {
  if (!has_air(settings)) return;
  gpu::Air& air = frame.air;
  air.extinction = extinction_of(settings.air);
  air.falloff =
      settings.air.height_m > 0 ? 1 / std::max(settings.air.height_m, min_air_height_m) : 0;
  air.level = scene_.bounds().empty() ? 0 : scene_.bounds().lower.y;
  air.asymmetry = settings.air.asymmetry;
  air.albedo = settings.air.albedo;
  air.candidates = settings.air.candidates;
  air.block = settings.air.block;
  next_.air = air;
}

void Renderer::fill_sampling(gpu::Frame& frame, const RenderSettings& chosen) const {
  const bool as_published = traits_of(chosen.sampling.estimator).as_published;
  const RenderSettings settings = as_published ? to_published(chosen) : chosen;
  const SamplingSettings& sampling = settings.sampling;
  frame.seed = sampling.seed;
  frame.candidates = sampling.candidates;
  frame.near_share = sampling.near_share;
  frame.far_share = std::min(sampling.far_share, 1.0f - frame.near_share);
  frame.uniform_share =
      std::clamp(sampling.uniform_share, 0.0f, 1.0f - frame.near_share - frame.far_share);
  // As published, candidates are uniform over all lights: vehicles' lights get the share that they
  // are.
  const double moving = double(frame.scene.light_count - frame.scene.static_lights);
  frame.vehicle_share = as_published ? float(moving / std::max(1.0, moving + frame.scene.lit_count))
                                     : sampling.vehicle_share;

  const ReuseSettings& reuse = settings.reuse;
  frame.neighbours = reuse.neighbours;
  frame.neighbour_radius = reuse.neighbour_radius_px;
  frame.max_history = reuse.max_history;
  const float falloff_m = std::max(reuse.history_falloff_m, min_history_falloff_m);
  frame.history_falloff = reuse.history_falloff_m <= 0 ? 0 : 1 / (falloff_m * falloff_m);
  frame.disocclusion_boost = reuse.disocclusion_boost;
  frame.pairings = pairings_of(reuse);
  // With the frame's number, so that two frames in a row sample all pixels.
  frame.half_rate = is_half_rate(settings) ? 1 + frame_number_ % 2 : 0;
  frame.pair_block = std::bit_ceil(static_cast<std::uint32_t>(reuse.neighbour_radius_px) + 1);
  // Fibonacci hashing: consecutive frames get distant corners.
  frame.permutation = reuse.permute ? (frame_number_ * 2654435769u) >> 28 : NO_PERMUTATION;
}

std::vector<FrameStep> Renderer::list_steps(const RenderSettings& settings,
                                            std::uint32_t slices) const {
  std::vector<FrameStep> steps = vehicle_passes_.list_steps(*passes_, frame_.address());
  steps.push_back(step_of(passes_->primary, "primary"));
  if (traits_of(settings.sampling.estimator).samples)
    add_restir(steps, settings);
  else
    add_reference(steps, settings, slices);
  add_end(steps, settings);
  return steps;
}

void Renderer::begin_frame(const scene::CameraPose& pose, const RenderSettings& settings,
                           const Effort& effort) {
  abandon_frame();
  check(settings);
  next_ = done_;
  next_.pose = scene::relative_to(scene_.origin(), pose);
  next_.settings = settings;
  next_.effort = effort;
  size_ = scale_size(picture_size_, settings.sampling.resolution_scale * effort.resolution_scale);
  restart_if_changed();
  passes_ = &library_.get(constants_of(settings));

  RenderSettings bounded = settings;
  bounded.sampling.candidates = std::min(settings.sampling.candidates, effort.max_candidates);
  bounded.reuse.neighbours = std::min(settings.reuse.neighbours, effort.max_neighbours);
  bounded.sampling.half_rate = settings.sampling.half_rate || effort.half_rate;
  gpu::Frame frame{};
  fill_buffers(frame, bounded);
  fill_view(frame);
  fill_sampling(frame, bounded);
  frame_.upload(&frame, sizeof(frame));
  next_.lit = frame.scene.lit;
  run_.start(list_steps(bounded, frame.slices));
  ++frame_number_;
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

void Renderer::inspect(gpu::Frame& frame, const DisplaySettings& display) {
  const PictureBuffers& picture = pictures_[parity_];
  const RenderSettings& settings = done_.settings;
  fill_display(frame, display);
  frame.scene = scene_.buffers();
  frame.surfaces = picture.surfaces.address();
  frame.spatial = picture.spatial.address();
  frame.layers = layers_.address();
  frame.candidates =
      traits_of(settings.sampling.estimator).samples ? settings.sampling.candidates : 0;
  exposed_frame_.upload(&frame, sizeof(frame));
  const gpu::Push push{exposed_frame_.address(), 0, 0};
  device_.run([&](VkCommandBuffer commands) {
    passes_->inspect.dispatch(commands, &push, frame.size.x, frame.size.y);
    gpu::full_barrier(commands);
  });
}

void Renderer::expose(const DisplaySettings& display) {
  if (done_.frames == 0 || !passes_) return;
  const PictureBuffers& picture = pictures_[parity_];
  gpu::Frame frame{};
  frame.size = picture.size;
  frame.display = picture.display.address();
  frame.accumulation =
      done_.settings.display.denoise ? denoised_.address() : picture.accumulation.address();
  if (shows(done_.settings, display.view))
    inspect(frame, display);
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

measure::Image Renderer::download(bool layers) const {
  measure::Image image;
  const PictureBuffers& picture = pictures_[parity_];
  const RenderSettings& settings = done_.settings;
  image.width = picture.size.x;
  image.height = picture.size.y;
  const std::size_t pixels = image.pixels();
  image.rgb.resize(3 * pixels);
  const gpu::Buffer& source = settings.display.denoise ? denoised_ : picture.accumulation;
  const auto sums = source.read<gpu::Accumulation>(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const glm::vec3 mean = mean_of(sums[i]);
    for (int c = 0; c < 3; ++c) image.rgb[3 * i + std::size_t(c)] = mean[c];
  }
  image.info.estimator = std::string(name_of(settings.sampling.estimator)) +
                         (settings.display.denoise ? ", denoised" : "");
  image.info.frames = done_.frames;
  image.info.candidates =
      traits_of(settings.sampling.estimator).samples ? settings.sampling.candidates : 0;
  image.info.neighbours = settings.reuse.neighbours;
  image.info.bounces = settings.indirect.bounces;
  image.info.indirect = describe_indirect(settings, scene_.buffers().light_count);
  image.info.left_out = name_parts(scene_.left_out());
  image.info.settings = describe_changes(settings);
  if (scene_.has_edited_lights())
    image.info.settings += image.info.settings.empty() ? "edited lights" : ", edited lights";
  image.info.seed = settings.sampling.seed;
  image.info.ev100 = settings.display.ev100;
  image.info.device = device_.label();
  const bool is_scaled = settings.sampling.resolution_scale * done_.effort.resolution_scale < 1;
  if (is_scaled)
    image.info.estimator += ", upscaled from " + std::to_string(picture.size.x) + " x " +
                            std::to_string(picture.size.y);
  RenderSettings as_done = settings;
  as_done.sampling.half_rate |= done_.effort.half_rate;
  if (is_half_rate(as_done))
    image.info.estimator += ", " + describe_half_rate(settings.averaging, done_.frames);
  if (!layers && is_scaled) return measure::upscale(image, picture_size_.x, picture_size_.y);
  if (!layers) return image;
  add_luminance_layer(image);
  // Layers are sums over the frames of the mean; a window has no such sum.
  if (settings.sampling.layers && settings.averaging.window == 0)
    add_light_layers(image, layers_.read<gpu::LayerSums>(pixels), done_.frames);
  const auto surfaces = picture.surfaces.read<gpu::Surface>(pixels);
  add_surface_layers(image, surfaces, scene_);
  if (settings.air.visibility_km > 0)
    add_transmittance_layer(image, surfaces, done_.air, done_.camera.position.y);
  if (is_scaled) return measure::upscale(image, picture_size_.x, picture_size_.y);
  return image;
}

measure::Image Renderer::sample_mean(std::size_t pixels) const {
  const PictureBuffers& picture = pictures_[parity_];
  measure::Image image;
  image.width = picture.size.x;
  const std::size_t rows = std::clamp<std::size_t>(pixels / picture.size.x, 1, picture.size.y);
  image.height = static_cast<std::uint32_t>(rows);
  image.rgb.resize(3 * image.pixels());
  const std::size_t row_bytes = picture.size.x * sizeof(gpu::Accumulation);
  const std::size_t surface_bytes = picture.size.x * sizeof(gpu::Surface);
  gpu::Buffer sampled(device_, rows * row_bytes, gpu::Memory::host),
      seen(device_, rows * surface_bytes, gpu::Memory::host);
  std::vector<VkBufferCopy> copies, surface_copies;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t row = picture.size.y * i / rows;
    copies.push_back({row * row_bytes, i * row_bytes, row_bytes});
    surface_copies.push_back({row * surface_bytes, i * surface_bytes, surface_bytes});
  }
  device_.run([&](VkCommandBuffer commands) {
    vkCmdCopyBuffer(commands, picture.accumulation.handle(), sampled.handle(),
                    static_cast<std::uint32_t>(copies.size()), copies.data());
    vkCmdCopyBuffer(commands, picture.surfaces.handle(), seen.handle(),
                    static_cast<std::uint32_t>(copies.size()), surface_copies.data());
    gpu::full_barrier(commands);
  });
  const auto* sums = static_cast<const gpu::Accumulation*>(sampled.mapped());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const glm::vec3 mean = mean_of(sums[i]);
    for (int c = 0; c < 3; ++c) image.rgb[3 * i + std::size_t(c)] = mean[c];
  }
  measure::ImageLayer emitters{"emitter", {"E"}, std::vector<float>(image.pixels())},
      lights{"light", {"I"}, std::vector<float>(image.pixels(), -1)};
  const auto* surfaces = static_cast<const gpu::Surface*>(seen.mapped());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (!(surfaces[i].depth > 0) || surfaces[i].light == NO_HIT) continue;
    emitters.values[i] = 1;
    lights.values[i] = static_cast<float>(surfaces[i].light);
  }
  image.layers.push_back(std::move(emitters));
  image.layers.push_back(std::move(lights));
  return image;
}

glm::vec3 Renderer::mean_at(glm::uvec2 pixel) const {
  const PictureBuffers& picture = pictures_[parity_];
  gpu::Accumulation sum{};
  picture.accumulation.download(&sum, sizeof sum,
                                (std::size_t{pixel.y} * picture.size.x + pixel.x) * sizeof sum);
  return mean_of(sum);
}

}  // namespace nightcity::render
