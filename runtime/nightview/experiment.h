// Error against cost: pictures of one scene, measured against its reference. What sweep, flight and
// strategies share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/measure/metrics.h"
#include "runtime/render/renderer.h"

namespace nightcity {

/// Of a mean of frames; where there were repeats, means over them.
struct Measurement {
  std::uint32_t frames = 0;
  double ms = 0;  // median of the frames' GPU time
  double rmse8 = 0, relative_mse = 0, mean_signed_error = 0, relative_mean_signed_error = 0,
         fireflies = 0;
};

/// Milliseconds of all passes of the renderer's last frame, by the device's clock.
double gpu_ms(const Renderer& renderer);

double median(std::vector<double> values);

/// Keeps a GPU at work for a second, by `render`: at rest it runs at a fraction of its clock, and frames of a
/// millisecond do not wake it. A CPU is left alone.
void wake(const gpu::Device& device, const std::function<void()>& render);

class Experiment {
 public:
  struct Options {
    gpu::Device::Options device;
    std::uint32_t width = 640, height = 360;
  };
  /// Throws Error where there is no device, or its queue has no timestamps.
  Experiment(RenderScene scene, const Options& options);

  const RenderScene& scene() const { return scene_; }
  std::string device_name() const { return device_->label(); }
  /// Throws Error where the validation layer found fault.
  void check_validation() const;

  /// The mean of `frames` frames with every light. `cache`, where not empty, is read when it exists and holds
  /// as many frames, else written; so it must be named after scene and view. `progress` is told the frames
  /// done.
  Image reference(const CameraPose& pose, RenderSettings settings, std::uint32_t frames,
                  const std::filesystem::path& cache,
                  const std::function<void(std::uint32_t)>& progress = {});

  /// Compiles the passes of the settings and wakes the device. By a renderer of its own: the frames that are
  /// measured draw the same random numbers however long it took.
  void warm_up(const CameraPose& pose, const RenderSettings& settings);

  /// Pictures of `repeats` seeds, each after `lead` frames that fill the history, taken at every count of
  /// `frames` (ascending) and compared with `truth`.
  std::vector<Measurement> measure(const CameraPose& pose, RenderSettings settings,
                                   const Image& truth, const std::vector<std::uint32_t>& frames,
                                   std::uint32_t lead, std::uint32_t repeats);

  Renderer& renderer() { return *renderer_; }

 private:
  RenderScene scene_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<DeviceScene> device_scene_;
  std::unique_ptr<PassLibrary> passes_;
  std::unique_ptr<Renderer> renderer_;
};

/// Changes whenever a scene's files do: 16 hexadecimal digits over the bytes of SCENE.glb and SCENE.lights.
std::string scene_fingerprint(const std::filesystem::path& glb);

/// 8 hexadecimal digits of a camera.
std::string pose_fingerprint(const CameraPose& pose);

}  // namespace nightcity
