#include "runtime/render/renderer.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/limits.h"
#include "runtime/render/image_layers.h"
#include "runtime/render/setting_table.h"

namespace nightcity::render {
namespace {

// Dispatches of the reference in one submission: long enough to hide the cost of submitting, short
// enough that no window system or driver watchdog believes that the device hangs.
constexpr std::uint32_t dispatches_per_submission = 16;

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

// Sub-pixel positions: the R2 sequence (Roberts 2018), starting at the pixel's centre.
float radical(double step, std::uint32_t frame) {
  const double x = 0.5 + step * double(frame);
  return static_cast<float>(std::min(x - std::floor(x), 0.99999994));
}

}  // namespace

Renderer::Renderer(gpu::Device& device, PassLibrary& passes, DeviceScene& scene,
                   std::uint32_t width, std::uint32_t height)
    : device_(device),
      library_(passes),
      scene_(scene),
      width_(width),
      height_(height),
      timer_(device),
      vehicle_passes_(device, scene),
      cache_(device) {
  if (width == 0 || height == 0 || width > measure::max_image_side ||
      height > measure::max_image_side)
    throw UsageError("--size", "a picture has 1 to " + std::to_string(measure::max_image_side) +
                                   " pixels a side");
  const std::size_t pixels = std::size_t{width} * height;
  frame_ = gpu::Buffer(device, sizeof(gpu::Frame), gpu::Memory::host);
  for (int i = 0; i < 2; ++i) {
    surfaces_[i] = gpu::Buffer(device, pixels * sizeof(gpu::Surface));
    spatial_[i] = gpu::Buffer(device, pixels * sizeof(gpu::Reservoir));
    accumulation_[i] = gpu::Buffer(device, pixels * sizeof(gpu::Accumulation));
  }
  reservoirs_ = gpu::Buffer(device, pixels * sizeof(gpu::Reservoir));
  radiance_ = gpu::Buffer(device, pixels * sizeof(gpu::Accumulation));
  display_ = gpu::Buffer(device, pixels * 4);
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
  constants[CONSTANT_GLOSS] = settings.environment.wetness > 0;
  constants[CONSTANT_LAYERS] = settings.sampling.layers;
  constants[CONSTANT_SCHEDULES] = scene_.has_schedules();
  constants[CONSTANT_TRAFFIC] = scene_.has_traffic();
  constants[CONSTANT_COUNT_RAYS] = settings.count_rays;
  constants[CONSTANT_INDIRECT] = find_indirect(settings);
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
void Renderer::run_pass(VkCommandBuffer commands, const Pass& pass, const char* name,
                        std::uint32_t first, std::uint32_t count, std::uint32_t slices) {
  const gpu::Push push{frame_.address(), first, count};
  pass.dispatch(commands, &push, width_, height_, slices);
  gpu::full_barrier(commands);
  timer_.mark(commands, name);
}

void Renderer::record_vehicles(VkCommandBuffer commands) {
  vehicle_passes_.record(commands, *passes_, frame_.address(),
                         [&](const char* name) { timer_.mark(commands, name); });
}

void Renderer::record_restir(VkCommandBuffer commands, const RenderSettings& settings) {
  run_pass(commands, passes_->candidates, "candidates");
  const EstimatorTraits& traits = traits_of(settings.sampling.estimator);
  if (traits.reuses && settings.reuse.max_history > 0)
    run_pass(commands, passes_->temporal, "temporal");
  if (traits.reuses && settings.reuse.neighbours > 0) {
    if (traits.pairs) {
      run_pass(commands, passes_->pair_targets, "spatial targets");
      run_pass(commands, passes_->pair_reuse, "spatial");
    } else {
      run_pass(commands, passes_->spatial, "spatial");
    }
  } else {
    const VkBufferCopy all{0, 0, reservoirs_.bytes()};
    vkCmdCopyBuffer(commands, reservoirs_.handle(), spatial_[parity_].handle(), 1, &all);
    gpu::full_barrier(commands);
    timer_.mark(commands, "copy");
  }
  if (find_indirect(settings) == INDIRECT_CACHE)
    cache_.record(commands, *passes_, frame_.address(),
                  [&](const char* name) { timer_.mark(commands, name); });
  run_pass(commands, passes_->shade, "shade");
}

void Renderer::record_end(VkCommandBuffer commands, const RenderSettings& settings) {
  run_pass(commands, passes_->accumulate, "accumulate");
  if (!settings.display.denoise) return;
  run_pass(commands, passes_->demodulate, "demodulate");
  for (std::uint32_t level = 0; level < DENOISE_LEVELS; ++level)
    run_pass(commands, passes_->denoise, "denoise", level);
}

void Renderer::submit(const std::function<void(VkCommandBuffer)>& record) {
  device_.run([&](VkCommandBuffer commands) {
    timer_.start(commands);
    record(commands);
  });
  const auto spans = timer_.collect();
  timings_.insert(timings_.end(), spans.begin(), spans.end());
}

// A picture of few pixels leaves most of a GPU idle, so chunks of lights go into slices side by
// side. Layers exist once, so they allow one slice.
std::uint32_t Renderer::reference_slices(const RenderSettings& settings) const {
  if (traits_of(settings.sampling.estimator).samples || settings.sampling.layers) return 1;
  const std::size_t pixels = std::size_t{width_} * height_;
  const std::size_t chunks = chunks_of(scene_.buffers().light_count);
  return static_cast<std::uint32_t>(
      std::clamp(std::min(busy_invocations / pixels, chunks), std::size_t{1}, max_slices));
}

void Renderer::render_reference(const RenderSettings& settings, std::uint32_t slices) {
  submit([&](VkCommandBuffer commands) {
    record_vehicles(commands);
    run_pass(commands, passes_->primary, "primary");
  });
  const std::uint32_t lights = scene_.buffers().light_count;
  const std::uint32_t lights_per_dispatch = REFERENCE_CHUNK * slices;
  std::uint32_t first = 0;
  do {  // without lights, one empty chunk writes the light that surfaces emit
    submit([&](VkCommandBuffer commands) {
      for (std::uint32_t i = 0; i < dispatches_per_submission && (first < lights || first == 0);
           ++i) {
        const std::uint32_t count = std::min(lights_per_dispatch, lights - first);
        run_pass(commands, passes_->reference, "reference", first, count,
                 std::max(chunks_of(count), 1u));
        first += lights_per_dispatch;
      }
    });
  } while (first < lights);
  add_reference_paths(settings);
  submit([&](VkCommandBuffer commands) { record_end(commands, settings); });
}

void Renderer::add_reference_paths(const RenderSettings& settings) {
  if (settings.indirect.bounces == 0) return;
  for (std::uint32_t path = 0; path < reference_paths(scene_.buffers().light_count); ++path)
    submit([&](VkCommandBuffer commands) {
      for (std::uint32_t bounce = 1; bounce <= settings.indirect.bounces; ++bounce)
        run_pass(commands, passes_->reference_path, "reference paths", path, bounce);
    });
}

void Renderer::check(const RenderSettings& settings) const {
  check_settings(settings);
  const float share = settings.sampling.vehicle_share;
  if (scene_.has_traffic() && !(share > 0 && share < 1))
    throw UsageError("--vehicle-share",
                     "must lie above 0 and below 1: vehicles' lights and static lights each need a "
                     "share");
}

void Renderer::restart_if_changed(const scene::CameraPose& pose, const RenderSettings& settings) {
  const bool same_settings = have_same_estimate(settings, settings_);
  const bool switched = scene_.set_time(settings.time_s);
  const bool moved = scene_.has_traffic() && settings.time_s != settings_.time_s;
  // A mean of all frames ends where anything moves; a mean of the last few follows the motion.
  const bool still = pose_ && same_view(pose, *pose_) && !switched && !moved;
  const AveragingSettings& averaging = settings.averaging;
  if (!same_settings || !averaging.accumulate || averaging.window != settings_.averaging.window ||
      (averaging.window == 0 && !still))
    frames_ = 0;
  // Reservoirs of other settings estimate something else; those of another view are reprojected.
  if (!same_settings) {
    has_history_ = false;
    cache_.clear();
  }
  moved_s_ = scene_.has_traffic() || scene_.has_schedules()
                 ? std::abs(settings.time_s - settings_.time_s)
                 : 0;
}

void Renderer::fill_buffers(gpu::Frame& frame, const RenderSettings& settings) {
  frame.scene = scene_.buffers();
  frame.previous_lit = has_history_ ? lit_ : frame.scene.lit;
  vehicle_passes_.enter(frame);
  frame.surfaces = surfaces_[parity_].address();
  frame.previous_surfaces = surfaces_[parity_ ^ 1].address();
  frame.reservoirs = reservoirs_.address();
  frame.spatial = spatial_[parity_].address();
  frame.previous_reservoirs = spatial_[parity_ ^ 1].address();
  frame.slices = reference_slices(settings);
  const std::size_t pixels = std::size_t{width_} * height_;
  const std::size_t radiance_bytes = frame.slices * pixels * sizeof(gpu::Accumulation);
  if (radiance_.bytes() < radiance_bytes) radiance_ = gpu::Buffer(device_, radiance_bytes);
  frame.radiance = radiance_.address();
  frame.accumulation = accumulation_[parity_].address();
  frame.previous_accumulation = accumulation_[parity_ ^ 1].address();
  if (settings.sampling.layers && layers_.bytes() == 0)
    layers_ = gpu::Buffer(device_, pixels * sizeof(gpu::LayerSums));
  frame.layers = layers_.address();
  for (int i = 0; i < 2; ++i) {
    if (settings.display.denoise && denoise_[i].bytes() == 0)
      denoise_[i] = gpu::Buffer(device_, pixels * sizeof(gpu::Demodulated));
    frame.denoise[i] = denoise_[i].address();
  }
  frame.display = display_.address();
  if (traits_of(settings.sampling.estimator).pairs) {
    const std::size_t pairings = pairings_of(settings.reuse);
    const auto reserve = [&](gpu::Buffer& buffer, std::size_t pictures) {
      const std::size_t bytes = pictures * pixels * sizeof(std::uint32_t);
      if (buffer.bytes() < bytes) buffer = gpu::Buffer(device_, bytes);
      return buffer.address();
    };
    frame.pair_partners = reserve(pair_partners_, pairings);
    frame.pair_targets = reserve(pair_targets_, 1 + pairings);
  }
  if (!traits_of(settings.sampling.estimator).samples && settings.indirect.bounces > 0 &&
      path_.bytes() == 0)
    path_ = gpu::Buffer(device_, pixels * sizeof(gpu::PathVertex));
  frame.path = path_.address();
  if (settings.count_rays) {
    if (ray_count_.bytes() == 0)
      ray_count_ = gpu::Buffer(device_, sizeof(std::uint32_t), gpu::Memory::host);
    constexpr std::uint32_t none = 0;
    ray_count_.upload(&none, sizeof none);
    frame.ray_count = ray_count_.address();
  }
}

void Renderer::fill_view(gpu::Frame& frame, const scene::CameraPose& pose,
                         const RenderSettings& settings) {
  frame.previous_camera = camera_;
  camera_ = scene::make_camera(pose, float(width_) / float(height_));
  frame.camera = camera_;
  frame.size = {width_, height_};
  frame.frame = frame_number_;
  const double before_s = has_history_ ? settings_.time_s : settings.time_s;
  frame.time_s = float(settings.time_s);
  frame.previous_time_s = float(before_s);
  frame.cycle_time_s = cycle_time(frame.scene.traffic.cycle, settings.time_s);
  frame.previous_cycle_time_s = cycle_time(frame.scene.traffic.cycle, before_s);
  frame.has_history = has_history_;
  // By frames in the mean, not by frame number: every estimator then gets the same sub-pixels.
  const std::uint32_t sub_pixel = settings.averaging.window == 0 ? frames_ : frame_number_;
  frame.jitter_x = settings.sampling.jitter ? radical(0.7548776662466927, sub_pixel) : 0.5f;
  frame.jitter_y = settings.sampling.jitter ? radical(0.5698402909980532, sub_pixel) : 0.5f;
  frame.reset = frames_ == 0;
  frame.window = settings.averaging.accumulate ? settings.averaging.window : 0;
  frame.exposure = tonemap::exposure_scale(settings.display.ev100);
  frame.tone = settings.display.tone;
  frame.bounces = settings.indirect.bounces;
  frame.reference_paths = reference_paths(frame.scene.light_count);
  if (find_indirect(settings) == INDIRECT_CACHE) cache_.enter(frame, settings.indirect, moved_s_);
  frame.wetness = settings.environment.wetness;
  frame.sky = settings.environment.sky_cd_m2;
  frame.moon_direction = settings.environment.moon_direction;
  frame.moon_lux = settings.environment.moon_lux;
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
  frame.pair_block = std::bit_ceil(static_cast<std::uint32_t>(reuse.neighbour_radius_px) + 1);
  // Fibonacci hashing: consecutive frames get distant corners.
  frame.permutation = reuse.permute ? (frame_number_ * 2654435769u) >> 28 : NO_PERMUTATION;
}

void Renderer::record(const RenderSettings& settings, std::uint32_t slices) {
  if (!traits_of(settings.sampling.estimator).samples) {
    render_reference(settings, slices);
    return;
  }
  submit([&](VkCommandBuffer commands) {
    record_vehicles(commands);
    run_pass(commands, passes_->primary, "primary");
    record_restir(commands, settings);
    record_end(commands, settings);
  });
  has_history_ = true;
}

void Renderer::render_frame(const scene::CameraPose& pose, const RenderSettings& settings) {
  check(settings);
  restart_if_changed(pose, settings);
  passes_ = &library_.get(constants_of(settings));
  parity_ ^= 1;

  gpu::Frame frame{};
  fill_buffers(frame, settings);
  fill_view(frame, pose, settings);
  fill_sampling(frame, settings);
  frame_.upload(&frame, sizeof(frame));

  lit_ = frame.scene.lit;
  timings_.clear();
  record(settings, frame.slices);
  pose_ = pose;
  settings_ = settings;
  ++frames_;
  if (settings.averaging.window > 0) frames_ = std::min(frames_, settings.averaging.window);
  ++frame_number_;
}

std::uint64_t Renderer::shadow_rays() const {
  return settings_.count_rays ? ray_count_.read<std::uint32_t>(1)[0] : 0;
}

measure::Image Renderer::download(bool layers) const {
  measure::Image image;
  image.width = width_;
  image.height = height_;
  const std::size_t pixels = image.pixels();
  image.rgb.resize(3 * pixels);
  const gpu::Buffer& source = settings_.display.denoise ? radiance_ : accumulation_[parity_];
  const auto sums = source.read<gpu::Accumulation>(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const glm::vec3 mean =
        sums[i].frames > 0 ? (sums[i].sum - sums[i].compensation) / sums[i].frames : glm::vec3(0);
    for (int c = 0; c < 3; ++c) image.rgb[3 * i + std::size_t(c)] = mean[c];
  }
  image.info.estimator = std::string(name_of(settings_.sampling.estimator)) +
                         (settings_.display.denoise ? ", denoised" : "");
  image.info.frames = frames_;
  image.info.candidates =
      traits_of(settings_.sampling.estimator).samples ? settings_.sampling.candidates : 0;
  image.info.neighbours = settings_.reuse.neighbours;
  image.info.bounces = settings_.indirect.bounces;
  image.info.indirect = describe_indirect(settings_);
  image.info.seed = settings_.sampling.seed;
  image.info.ev100 = settings_.display.ev100;
  image.info.device = device_.label();
  if (!layers) return image;
  add_luminance_layer(image);
  // Layers are sums over the frames of the mean; a window has no such sum.
  if (settings_.sampling.layers && settings_.averaging.window == 0)
    add_light_layers(image, layers_.read<gpu::LayerSums>(pixels), frames_);
  add_surface_layers(image, surfaces_[parity_].read<gpu::Surface>(pixels), scene_);
  return image;
}

}  // namespace nightcity::render
