// The results of a renderer: what the display shows, pictures with their layers, and figures.
#include "runtime/measure/upscale.h"
#include "runtime/render/frame_values.h"
#include "runtime/render/image_layers.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/picture_download.h"
#include "runtime/render/renderer.h"
#include "runtime/render/setting_table.h"
#include "runtime/render/settings_file.h"

namespace nightcity::render {
namespace {

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

}  // namespace

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
