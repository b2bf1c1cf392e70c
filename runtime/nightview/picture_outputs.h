// The files of a rendered picture, and what those that are looked at show.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/measure/false_colour.h"
#include "runtime/render/renderer.h"

namespace nightcity::nightview {

struct PictureOutputs {
  std::vector<std::string> files;  // .png or .exr
  std::string show = "picture";    // of a PNG: --show
  bool markers = false;            // of every light, in a PNG
};

/// Returns which light an illuminance that is shown counts; nothing for what else is shown.
std::optional<measure::Illumination> find_illumination(const std::string& show);

/// Returns the view (VIEW_*) that the device shows and no figures are made of; nothing for others.
std::optional<std::uint32_t> find_device_view(const std::string& show);

/// Returns whether a picture is written with figures: an EXR is.
bool writes_figures(const PictureOutputs& outputs);

/// Call it before any work: a wrong name should not be found out after the last frame. Throws
/// UsageError for names of other files and folders that cannot be written to.
void check_outputs(const PictureOutputs& outputs);

/// Writes the picture to all files: a PNG as a camera takes it, or a quantity in false colours with
/// a scale. Throws Error where one cannot be written.
void write_outputs(const PictureOutputs& outputs, const measure::Image& image,
                   render::Renderer& renderer, const render::DisplaySettings& display,
                   const scene::RenderScene& scene, const scene::CameraPose& pose);

}  // namespace nightcity::nightview
