// Pictures along a camera path at fixed steps of time, as a film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "runtime/render/renderer.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::nightview {

struct RecordingOptions {
  std::filesystem::path folder;  // gets frame-NNNNN.png (and .exr) and record.json
  std::string scene, path;       // as the user named them: part of what a recording is
  double duration_s = 10;        // from the path's beginning to its end
  double pictures_per_s = 25;
  double clock_speed = 1;      // seconds of the night per second of the film
  std::uint32_t frames = 16;   // averaged in each picture
  bool exr = false;            // writes OpenEXR beside each PNG
  std::optional<float> ev100;  // not set: metered from the first picture
};

/// Returns the number of pictures, at least 1.
std::uint32_t count_pictures(const RecordingOptions& options);

/// Renders the pictures that are not in the folder yet, one after the other, and calls `progress`
/// after each with the number of those that are there. A recording that was ended goes on where it
/// was: record.json tells whether it is the same one. Every picture is a mean of its own, without
/// the samples of the one before. Returns how many were rendered. Throws Error, also where the
/// folder holds another recording.
std::uint32_t record(const RecordingOptions& options, render::Renderer& renderer,
                     const scene::RenderScene& scene, const scene::CameraPath& path,
                     render::RenderSettings settings,
                     const std::function<void(std::uint32_t)>& progress);

/// Makes `film` of the pictures with ffmpeg. Returns false where ffmpeg is not installed. Throws
/// Error where it fails.
bool make_film(const RecordingOptions& options, const std::filesystem::path& film);

}  // namespace nightcity::nightview
