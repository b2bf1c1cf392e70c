// Fills in what shaders read of a frame: its gpu::Frame, with the buffers that it reads and writes.
#include "runtime/render/frame_steps.h"
#include "runtime/render/frame_values.h"
#include "runtime/render/pass_constants.h"
#include "runtime/render/renderer.h"

namespace nightcity::render {

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
    frame.pair_samples =
        reserve(pair_samples_, (1 + pairings) * pixels * sizeof(gpu::ReflectedSample));
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
  frame.frames_at_rest = frame.window == 0 ? next_.frames : 0;
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

}  // namespace nightcity::render
