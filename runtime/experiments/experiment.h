// Error against cost: pictures of one scene, measured against its reference. Sweep, flight and
// strategies are made of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/measure/metrics.h"
#include "runtime/render/renderer.h"

namespace nightcity::experiments {

/// Error and cost of the mean of `frames` frames; with repeats, the errors are averaged over them.
struct Measurement {
  std::uint32_t frames = 0;
  double ms = 0;  // median of the frames' GPU times
  // As in Comparison (runtime/measure/metrics.h).
  double rmse8 = 0, relative_mse = 0, mean_signed_error = 0, relative_mean_signed_error = 0,
         fireflies = 0;
  // Half the widths of the 95 % confidence intervals over the repeats; nothing for a single one.
  std::optional<double> rmse8_ci95, relative_mse_ci95, relative_mean_signed_error_ci95;
};

/// Returns the milliseconds of all passes of the renderer's last frame, by the device's clock.
double sum_gpu_ms(const render::Renderer& renderer);

/// Calls `render` for a second on a GPU, and not at all on a CPU. An idle GPU runs at a fraction of
/// its clock rate, and a few frames of a millisecond do not raise it.
void wake(const gpu::Device& device, const std::function<void()>& render);

class Experiment {
 public:
  struct Options {
    gpu::Device::Options device;
    std::uint32_t width = 640, height = 360;
  };
  /// Throws Error where there is no device, or its queue has no timestamps.
  Experiment(scene::RenderScene scene, const Options& options);

  const scene::RenderScene& scene() const { return scene_; }
  std::string device_name() const { return device_->label(); }
  /// Throws Error when the validation layer found a fault.
  void check_validation() const;

  /// Returns the mean of `frames` frames with every light. `cache`, unless empty, is read when it
  /// exists and fits size and frames, else written; its name must identify scene and view.
  /// `progress` is called with the number of finished frames.
  measure::Image reference(const scene::CameraPose& pose, render::RenderSettings settings,
                           std::uint32_t frames, const std::filesystem::path& cache,
                           const std::function<void(std::uint32_t)>& progress = {});

  /// Compiles the passes of the settings and wakes the device. It uses a renderer of its own: the
  /// frames that are measured draw the same random numbers however long this took.
  void warm_up(const scene::CameraPose& pose, const render::RenderSettings& settings);

  /// Wakes a device that has been idle, as while the host looked at a picture, with frames of
  /// another renderer, for a tenth of a second; does nothing on a CPU.
  void wake_up(const scene::CameraPose& pose, const render::RenderSettings& settings);

  /// Renders pictures of `repeats` seeds, each after `lead` frames that fill the history, and
  /// compares them with `truth` at every count of `frames` (ascending). Returns one measurement per
  /// count. With `time_step_s` above 0 the clock moves on by it before every frame and reaches the
  /// settings' time in the picture that is compared, which is then one frame whatever `frames`
  /// says.
  std::vector<Measurement> measure(const scene::CameraPose& pose, render::RenderSettings settings,
                                   const measure::Image& truth,
                                   const std::vector<std::uint32_t>& frames, std::uint32_t lead,
                                   std::uint32_t repeats, double time_step_s = 0);

  render::Renderer& renderer() { return *renderer_; }
  /// Returns another renderer of the same scene and size.
  render::Renderer make_renderer() const;

 private:
  // Starts mean and history anew with a seed and fills the history; the last frame, at the
  // settings' time, is the first of the mean. Returns the GPU times of the frames.
  std::vector<double> start_run(const scene::CameraPose& pose, render::RenderSettings& settings,
                                std::uint32_t seed, std::uint32_t lead, double time_step_s);

  scene::RenderScene scene_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<render::DeviceScene> device_scene_;
  std::unique_ptr<render::PassLibrary> passes_;
  std::unique_ptr<render::Renderer> renderer_;
};

}  // namespace nightcity::experiments
