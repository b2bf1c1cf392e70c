#include "runtime/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <type_traits>

#include "formats/error.h"
#include "runtime/measure/exposure.h"

namespace nightcity {
namespace {

// Dispatches of the reference recorded into one submission: long enough to hide its cost, short enough that a
// window system or driver watchdog does not take the device for hung.
constexpr std::uint32_t dispatches_a_submission = 16;

// Invocations that fill the largest devices twice, and pictures that may lie in slices beside each other.
constexpr std::size_t busy_invocations = std::size_t{1} << 19;
constexpr std::size_t max_slices = 32;

constexpr std::uint32_t chunks_of(std::uint32_t lights) {
  return lights / REFERENCE_CHUNK + (lights % REFERENCE_CHUNK != 0);
}

bool same_view(const CameraPose& a, const CameraPose& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg;
}

// Settings that only change how the mean is shown do not restart it.
bool same_estimate(const RenderSettings& a, const RenderSettings& b) {
  return a.estimator == b.estimator && a.candidates == b.candidates &&
         a.neighbours == b.neighbours && a.neighbour_radius_px == b.neighbour_radius_px &&
         a.history_cap == b.history_cap && a.reach_m == b.reach_m && a.boost == b.boost &&
         a.permute == b.permute && a.uniform_share == b.uniform_share &&
         a.fleet_share == b.fleet_share && a.local_share == b.local_share &&
         a.wide_share == b.wide_share && a.visibility_reuse == b.visibility_reuse &&
         a.jitter == b.jitter && a.seed == b.seed && a.sky_cd_m2 == b.sky_cd_m2 &&
         a.layers == b.layers && a.moon_direction == b.moon_direction && a.moon_lux == b.moon_lux &&
         a.wetness == b.wetness;
}

// Sub-pixel positions: the R2 sequence (Roberts 2018), starting at the pixel's centre.
float radical(double step, std::uint32_t frame) {
  const double x = 0.5 + step * double(frame);
  return static_cast<float>(std::min(x - std::floor(x), 0.99999994));
}

glm::vec3 unpack_normal(std::uint32_t packed) {
  const auto snorm = [](std::uint32_t bits) {
    return std::clamp(float(static_cast<std::int16_t>(bits)) / 32767.0f, -1.0f, 1.0f);
  };
  const float x = snorm(packed & 0xFFFFu), y = snorm(packed >> 16);
  glm::vec3 n(x, y, 1.0f - std::abs(x) - std::abs(y));
  if (n.z < 0) {
    n.x = (1.0f - std::abs(y)) * (x >= 0 ? 1.0f : -1.0f);
    n.y = (1.0f - std::abs(x)) * (y >= 0 ? 1.0f : -1.0f);
  }
  return glm::normalize(n);
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
      fleet_(device, scene) {
  if (width == 0 || height == 0 || width > max_image_side || height > max_image_side)
    throw UsageError("--size",
                     "a picture has 1 to " + std::to_string(max_image_side) + " pixels a side");
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
  constants[CONSTANT_ESTIMATOR] = static_cast<std::uint32_t>(settings.estimator);
  constants[CONSTANT_PROFILES] = scene_.has_profiles();
  constants[CONSTANT_RECTANGLES] = scene_.has_rectangles();
  constants[CONSTANT_VISIBILITY_REUSE] = settings.visibility_reuse;
  const bool sky = settings.sky_cd_m2 != glm::vec3(0), moon = settings.moon_lux != glm::vec3(0);
  constants[CONSTANT_SKY] = sky && scene_.has_sky_map() ? SKY_MAP
                            : sky || moon               ? SKY_UNIFORM
                                                        : SKY_DARK;
  constants[CONSTANT_GLOSS] = settings.wetness > 0;
  constants[CONSTANT_LAYERS] = settings.layers;
  constants[CONSTANT_SCHEDULES] = scene_.has_schedules();
  constants[CONSTANT_TRAFFIC] = scene_.has_fleet();
  for (const Feature& feature : needless_features())
    if ((settings.needless >> feature.constant & 1u) != 0 && constants[feature.constant] == 0)
      constants[feature.constant] = 1;
  return constants;
}

std::vector<Feature> Renderer::not_needed(const RenderSettings& settings) const {
  const PassConstants constants = constants_of(settings);
  std::vector<Feature> features;
  for (const Feature& feature : needless_features())
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

void Renderer::record_fleet(VkCommandBuffer commands) {
  fleet_.record(commands, *passes_, frame_.address(),
                [&](const char* name) { timer_.mark(commands, name); });
}

void Renderer::record_restir(VkCommandBuffer commands, const RenderSettings& settings) {
  run_pass(commands, passes_->candidates, "candidates");
  const bool reuse = settings.estimator != Estimator::ris;
  if (reuse && settings.history_cap > 0) run_pass(commands, passes_->temporal, "temporal");
  if (reuse && settings.neighbours > 0) {
    run_pass(commands, passes_->spatial, "spatial");
  } else {
    const VkBufferCopy all{0, 0, reservoirs_.bytes()};
    vkCmdCopyBuffer(commands, reservoirs_.handle(), spatial_[parity_].handle(), 1, &all);
    gpu::full_barrier(commands);
    timer_.mark(commands, "copy");
  }
  run_pass(commands, passes_->shade, "shade");
}

void Renderer::record_end(VkCommandBuffer commands, const RenderSettings& settings) {
  run_pass(commands, passes_->accumulate, "accumulate");
  if (!settings.denoise) return;
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

// Few pixels leave most of a GPU idle. Layers have one picture to add to.
std::uint32_t Renderer::reference_slices(const RenderSettings& settings) const {
  if (settings.estimator != Estimator::reference || settings.layers) return 1;
  const std::size_t pixels = std::size_t{width_} * height_;
  const std::size_t chunks = chunks_of(scene_.buffers().light_count);
  return static_cast<std::uint32_t>(
      std::clamp(std::min(busy_invocations / pixels, chunks), std::size_t{1}, max_slices));
}

void Renderer::render_reference(const RenderSettings& settings, std::uint32_t slices) {
  submit([&](VkCommandBuffer commands) {
    record_fleet(commands);
    run_pass(commands, passes_->primary, "primary");
  });
  const std::uint32_t lights = scene_.buffers().light_count;
  const std::uint32_t a_dispatch = REFERENCE_CHUNK * slices;
  std::uint32_t first = 0;
  do {  // a chunk of no lights still writes what surfaces emit
    submit([&](VkCommandBuffer commands) {
      for (std::uint32_t i = 0; i < dispatches_a_submission && (first < lights || first == 0);
           ++i) {
        const std::uint32_t count = std::min(a_dispatch, lights - first);
        run_pass(commands, passes_->reference, "reference", first, count,
                 std::max(chunks_of(count), 1u));
        first += a_dispatch;
      }
    });
  } while (first < lights);
  submit([&](VkCommandBuffer commands) { record_end(commands, settings); });
}

void Renderer::render_frame(const CameraPose& pose, const RenderSettings& settings) {
  if (settings.candidates < 1 || settings.candidates > max_candidates)
    throw UsageError("--candidates", "1 to " + std::to_string(max_candidates));
  if (settings.neighbours > max_neighbours)
    throw UsageError("--neighbours", "0 to " + std::to_string(max_neighbours));
  // A light that is never picked is missing from the picture, and nothing in it says so.
  if (settings.local_share + settings.wide_share > 0.999f)
    throw UsageError(
        "--local-share",
        "and --wide-share: together at most 0.999, lights that no list holds want a share too");
  if (scene_.has_fleet() && !(settings.fleet_share > 0 && settings.fleet_share < 1))
    throw UsageError("--fleet-share",
                     "above 0 and below 1: vehicles and what stands want a share each");

  const bool same_settings = same_estimate(settings, settings_);
  const bool switched = scene_.set_time(settings.time_s);
  const bool moved = scene_.has_fleet() && settings.time_s != settings_.time_s;
  // A mean of all frames ends where anything moves; one of the last few goes along with it.
  const bool still = pose_ && same_view(pose, *pose_) && !switched && !moved;
  if (!same_settings || !settings.accumulate || settings.window != settings_.window ||
      (settings.window == 0 && !still))
    frames_ = 0;
  // Reservoirs of another estimator mean something else; those of another view are reprojected.
  if (!same_settings) has_history_ = false;
  passes_ = &library_.get(constants_of(settings));
  parity_ ^= 1;

  gpu::Frame frame{};
  frame.scene = scene_.buffers();
  frame.previous_lit = has_history_ ? lit_ : frame.scene.lit;
  fleet_.enter(frame);
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
  if (settings.layers && layers_.bytes() == 0)
    layers_ = gpu::Buffer(device_, pixels * sizeof(gpu::LightLayers));
  frame.layers = layers_.address();
  for (int i = 0; i < 2; ++i) {
    if (settings.denoise && denoise_[i].bytes() == 0)
      denoise_[i] = gpu::Buffer(device_, pixels * sizeof(gpu::Demodulated));
    frame.denoise[i] = denoise_[i].address();
  }
  frame.display = display_.address();
  frame.previous_camera = camera_;
  camera_ = make_camera(pose, float(width_) / float(height_));
  frame.camera = camera_;
  frame.size = {width_, height_};
  frame.frame = frame_number_;
  frame.seed = settings.seed;
  frame.candidates = settings.candidates;
  frame.neighbours = settings.neighbours;
  frame.neighbour_radius = settings.neighbour_radius_px;
  frame.max_history = settings.history_cap;
  // As published: uniform picks, no boost, no permutation, every M in full.
  const bool as_published = settings.estimator == Estimator::paper;
  frame.history_falloff =
      as_published || settings.reach_m <= 0 ? 0 : 1 / (settings.reach_m * settings.reach_m);
  frame.disocclusion_boost = as_published ? 0 : settings.boost;
  // Fibonacci hashing: neighbouring frames get distant corners.
  frame.permutation =
      settings.permute && !as_published ? (frame_number_ * 2654435769u) >> 28 : NO_PERMUTATION;
  frame.near_share = as_published ? 0.0f : std::clamp(settings.local_share, 0.0f, 1.0f);
  frame.far_share =
      as_published ? 0.0f : std::clamp(settings.wide_share, 0.0f, 1.0f - frame.near_share);
  frame.uniform_share = as_published ? 1.0f
                                     : std::clamp(settings.uniform_share, 0.0f,
                                                  1.0f - frame.near_share - frame.far_share);
  // As published, candidates are uniform over all lights: each set has its share of them.
  const double moving = double(frame.scene.light_count - frame.scene.static_lights);
  frame.vehicle_share = as_published ? float(moving / std::max(1.0, moving + frame.scene.lit_count))
                                     : settings.fleet_share;
  const double before_s = has_history_ ? settings_.time_s : settings.time_s;
  frame.time_s = float(settings.time_s);
  frame.previous_time_s = float(before_s);
  frame.cycle_time_s = cycle_time(frame.scene.traffic.cycle, settings.time_s);
  frame.previous_cycle_time_s = cycle_time(frame.scene.traffic.cycle, before_s);
  frame.has_history = has_history_;
  // By frames in the mean, not by frame number: every estimator then sees the same sub-pixels.
  const std::uint32_t sub_pixel = settings.window == 0 ? frames_ : frame_number_;
  frame.jitter_x = settings.jitter ? radical(0.7548776662466927, sub_pixel) : 0.5f;
  frame.jitter_y = settings.jitter ? radical(0.5698402909980532, sub_pixel) : 0.5f;
  frame.exposure = tonemap::exposure_scale(settings.ev100);
  frame.reset = frames_ == 0;
  // A window of one frame is no window, and the first frame has nothing to go along with.
  frame.window = settings.accumulate ? settings.window : 0;
  frame.wetness = std::clamp(settings.wetness, 0.0f, 1.0f);
  frame.sky = settings.sky_cd_m2;
  frame.moon_direction = settings.moon_direction;
  frame.moon_lux = settings.moon_lux;
  frame.tone = settings.tone;
  frame_.upload(&frame, sizeof(frame));

  lit_ = frame.scene.lit;
  timings_.clear();
  if (settings.estimator == Estimator::reference) {
    render_reference(settings, frame.slices);
  } else {
    submit([&](VkCommandBuffer commands) {
      record_fleet(commands);
      run_pass(commands, passes_->primary, "primary");
      record_restir(commands, settings);
      record_end(commands, settings);
    });
    has_history_ = true;
  }
  pose_ = pose;
  settings_ = settings;
  ++frames_;
  if (settings.window > 0) frames_ = std::min(frames_, settings.window);
  ++frame_number_;
}

Image Renderer::download(bool layers) const {
  Image image;
  image.width = width_;
  image.height = height_;
  const std::size_t pixels = image.pixels();
  image.rgb.resize(3 * pixels);
  const gpu::Buffer& source = settings_.denoise ? radiance_ : accumulation_[parity_];
  const auto sums = source.read<gpu::Accumulation>(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const glm::vec3 mean =
        sums[i].frames > 0 ? (sums[i].sum - sums[i].compensation) / sums[i].frames : glm::vec3(0);
    for (int c = 0; c < 3; ++c) image.rgb[3 * i + std::size_t(c)] = mean[c];
  }
  image.info.estimator =
      std::string(name_of(settings_.estimator)) + (settings_.denoise ? ", denoised" : "");
  image.info.frames = frames_;
  image.info.candidates = settings_.estimator == Estimator::reference ? 0 : settings_.candidates;
  image.info.neighbours = settings_.neighbours;
  image.info.seed = settings_.seed;
  image.info.ev100 = settings_.ev100;
  image.info.device = device_.label();
  if (layers) add_layers(image);
  return image;
}

void Renderer::add_layers(Image& image) const {
  const std::size_t pixels = image.pixels();
  const auto add = [&](const char* name, std::vector<std::string> channels) -> std::vector<float>& {
    image.layers.push_back({name, std::move(channels), {}});
    image.layers.back().values.reserve(pixels * image.layers.back().channels.size());
    return image.layers.back().values;
  };
  const auto put = [](std::vector<float>& values, const glm::vec3& v) {
    values.insert(values.end(), {v.x, v.y, v.z});
  };

  std::vector<float>& luminance = add("luminance", {"Y"});
  for (std::size_t i = 0; i < pixels; ++i)
    luminance.push_back(
        tonemap::luminance_709(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]));

  // Sums of the frames of this mean: a window has no such sum.
  if (settings_.layers && settings_.window == 0) {
    const auto sums = layers_.read<gpu::LightLayers>(pixels);
    const auto add_sum = [&](const char* name, glm::vec3 gpu::LightLayers::*sum) {
      std::vector<float>& values = add(name, {"R", "G", "B"});
      for (const gpu::LightLayers& s : sums) put(values, s.*sum / float(frames_));
    };
    add_sum("direct_lamps", &gpu::LightLayers::lamps);
    add_sum("direct_windows", &gpu::LightLayers::windows);
    add_sum("direct_vehicles", &gpu::LightLayers::vehicles);
    add_sum("sky", &gpu::LightLayers::sky);
    add_sum("emitted", &gpu::LightLayers::emitted);
  }

  const auto surfaces = surfaces_[parity_].read<gpu::Surface>(pixels);
  const auto add_seen = [&](const char* name, std::vector<std::string> channels, auto&& value_of) {
    std::vector<float>& values = add(name, std::move(channels));
    for (const gpu::Surface& s : surfaces) {
      if constexpr (std::is_same_v<decltype(value_of(s)), float>) {
        values.push_back(value_of(s));
      } else {
        put(values, value_of(s));
      }
    }
  };
  const auto hit = [](const gpu::Surface& s) { return s.depth > 0; };
  add_seen("albedo", {"R", "G", "B"}, [&](const gpu::Surface& s) {
    return hit(s) ? scene_.albedo(s.material) : glm::vec3(0);
  });
  add_seen("normal", {"X", "Y", "Z"},
           [&](const gpu::Surface& s) { return hit(s) ? unpack_normal(s.normal) : glm::vec3(0); });
  add_seen("position", {"X", "Y", "Z"}, [](const gpu::Surface& s) { return s.position; });
  add_seen("motion", {"X", "Y", "Z"}, [](const gpu::Surface& s) { return s.motion; });
  add_seen("depth", {"Z"}, [](const gpu::Surface& s) { return s.depth; });
  add_seen("material", {"id"},
           [&](const gpu::Surface& s) { return hit(s) ? float(s.material) : -1.0f; });
  add_seen("feature", {"id"}, [&](const gpu::Surface& s) {
    return hit(s) && s.feature != NO_HIT ? float(s.feature) : -1.0f;
  });
}

}  // namespace nightcity
