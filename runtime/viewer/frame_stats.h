// The figures that the panel and the caption report of the scene and the last frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/timer.h"
#include "runtime/render/settings.h"
#include "runtime/viewer/city.h"
#include "runtime/viewer/live_picture.h"

namespace nightcity::viewer {

struct FrameStats {
  std::string scene, device, trace;  // scene: "" while the first is opened
  std::size_t triangles = 0, lights = 0;
  bool has_light = true;                // lights or traffic; else the panel offers sky and moon
  std::vector<std::string> licences;    // of the data
  std::vector<std::string> cities;      // that can be opened
  std::uint32_t width = 0, height = 0;  // of the rendered picture
  std::uint32_t divisor = 1;            // of the window's sides, that the picture has
  std::uint32_t frames = 0;             // in the mean
  // The settings of the picture on the screen, where the next one is still being rendered.
  std::optional<render::RenderSettings> made_with;
  double frame_ms = 0;    // of the device
  std::string pace;       // how frames keep to their budget; "" without one
  std::string reference;  // what the picture is compared with, in words; "" without that view
  bool films = false;     // a film is being recorded
  std::string work;       // what goes on: "rendering every 2nd pixel, 40 %"
  std::string place;      // where the camera is, in words
  std::vector<gpu::Timer::Span> passes;  // a copy: the picture may go before the panel is drawn
  std::vector<float> times_ms;           // of the last frames, the newest last
  std::uint64_t device_bytes = 0, process_bytes = 0;  // of memory that this program has
};

/// Enters what a city has.
void describe_city(const City& city, FrameStats& stats);
/// Enters what memory the program has on the device and in all.
void describe_memory(const gpu::Device& device, FrameStats& stats);
/// Returns what a picture is compared with: "the reference: 3 frames of 320 x 180".
std::string describe_reference(const render::Renderer& renderer);
/// Enters what the picture on the screen is.
void describe_picture(const LivePicture& picture, FrameStats& stats);

}  // namespace nightcity::viewer
