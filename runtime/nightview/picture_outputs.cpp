#include "runtime/nightview/picture_outputs.h"

#include <algorithm>
#include <filesystem>

#include "formats/error.h"
#include "formats/program/output.h"
#include "formats/to_lower.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/png.h"
#include "runtime/scene/markers.h"

namespace nightcity::nightview {
namespace {

bool has_extension(const std::string& file, const char* extension) {
  return to_lower(std::filesystem::path(file).extension().string()) == extension;
}

// Draws lamps as green squares and windows as single blue pixels: no night picture has these
// colours itself.
void draw_markers(measure::Image8& picture, const scene::RenderScene& scene,
                  const gpu::Camera& camera) {
  constexpr std::size_t max_markers = 1'000'000;
  for (const scene::Marker& marker : scene::find_markers(camera, scene.lights, max_markers)) {
    const auto x = static_cast<std::uint32_t>(marker.at.x * float(picture.width));
    const auto y = static_cast<std::uint32_t>(marker.at.y * float(picture.height));
    const bool window = scene.families[marker.light] == LightFamily::window;
    const int half = window ? 0 : 1;
    for (int dy = -half; dy <= half; ++dy)
      for (int dx = -half; dx <= half; ++dx) {
        const std::int64_t px = std::int64_t{x} + dx, py = std::int64_t{y} + dy;
        if (px < 0 || py < 0 || px >= picture.width || py >= picture.height) continue;
        std::uint8_t* to = &picture.rgb[3 * (static_cast<std::size_t>(py) * picture.width +
                                             static_cast<std::size_t>(px))];
        to[0] = 0;
        to[1] = window ? 120 : 255;
        to[2] = window ? 255 : 0;
      }
  }
}

measure::Image8 show_on_device(std::uint32_t view, render::DisplaySettings display,
                               render::Renderer& renderer) {
  display.view = view;
  renderer.expose(display);
  measure::Image8 picture{renderer.width(), renderer.height(), {}};
  for (const std::uint32_t word :
       renderer.display().read<std::uint32_t>(std::size_t{picture.width} * picture.height))
    for (const unsigned shift : {0u, 8u, 16u})
      picture.rgb.push_back(static_cast<std::uint8_t>(word >> shift));
  return picture;
}

// Returns the PNG's picture: as a camera takes it or a quantity in false colours, with markers
// where asked for.
measure::Image8 make_png(const PictureOutputs& outputs, const measure::Image& image,
                         render::Renderer& renderer, const render::DisplaySettings& display,
                         const scene::RenderScene& scene, const scene::CameraPose& pose) {
  measure::Image8 picture;
  if (outputs.show == "luminance") {
    const std::vector<float> values = measure::luminance_of(image);
    picture = measure::false_colour(values, image.width, image.height,
                                    measure::fitting_scale(values, "cd/m2"));
  } else if (const auto part = find_illumination(outputs.show)) {
    const std::vector<float> values = measure::illuminance_of(image, *part);
    picture = measure::false_colour(values, image.width, image.height,
                                    measure::fitting_scale(values, "lx"));
  } else if (const auto view = find_device_view(outputs.show)) {
    picture = show_on_device(*view, display, renderer);
  } else {
    picture = renderer.develop(image, display);
  }
  if (outputs.markers)
    draw_markers(picture, scene,
                 scene::make_camera(pose, float(image.width) / float(image.height)));
  return picture;
}

}  // namespace

std::optional<measure::Illumination> find_illumination(const std::string& show) {
  if (show == "illuminance") return measure::Illumination::all;
  if (show == "direct-illuminance") return measure::Illumination::direct;
  if (show == "indirect-illuminance") return measure::Illumination::indirect;
  return std::nullopt;
}

std::optional<std::uint32_t> find_device_view(const std::string& show) {
  if (show == "wireframe") return VIEW_WIREFRAME;
  if (show == "tiles") return VIEW_TILES;
  return std::nullopt;
}

bool writes_figures(const PictureOutputs& outputs) {
  return std::any_of(outputs.files.begin(), outputs.files.end(),
                     [](auto& file) { return has_extension(file, ".exr"); });
}

void check_outputs(const PictureOutputs& outputs) {
  for (const std::string& file : outputs.files) {
    if (!has_extension(file, ".png") && !has_extension(file, ".exr"))
      throw UsageError("--out", "'" + file + "': a picture's name ends in .png or .exr");
    program::require_writable_folder_of(file);
  }
}

void write_outputs(const PictureOutputs& outputs, const measure::Image& image,
                   render::Renderer& renderer, const render::DisplaySettings& display,
                   const scene::RenderScene& scene, const scene::CameraPose& pose) {
  for (const std::string& file : outputs.files) {
    if (has_extension(file, ".exr"))
      measure::write_exr(file, image);
    else
      measure::write_png(file, make_png(outputs, image, renderer, display, scene, pose),
                         measure::png_text(image.info));
  }
}

}  // namespace nightcity::nightview
