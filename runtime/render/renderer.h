// Renders a scene frame by frame on a device and keeps the running mean of the frames.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/compute_pass.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/timer.h"
#include "runtime/measure/image.h"
#include "runtime/render/device_scene.h"
#include "runtime/render/irradiance_cache.h"
#include "runtime/render/pass_library.h"
#include "runtime/render/settings.h"
#include "runtime/render/vehicle_passes.h"
#include "runtime/scene/camera.h"

namespace nightcity::render {

class Renderer {
 public:
  /// Device, passes and scene must outlive the renderer. Throws Error when the device has too
  /// little memory, UsageError when a side is 0 or above max_image_side.
  Renderer(gpu::Device& device, PassLibrary& passes, DeviceScene& scene, std::uint32_t width,
           std::uint32_t height);

  /// Renders one frame and adds it to the mean. The mean starts anew when the camera, the time or a
  /// setting that have_same_estimate compares has changed since the last frame. Reservoirs are
  /// reprojected where only the camera or the time changed, else discarded. Switches the scene's
  /// lights to the settings' time. Throws UsageError when a setting is out of range.
  void render_frame(const scene::CameraPose& pose, const RenderSettings& settings);

  /// Returns the features that neither the scene nor the settings need: passes are compiled without
  /// them.
  std::vector<Feature> list_unneeded(const RenderSettings& settings) const;

  /// Returns the number of frames in the mean.
  std::uint32_t frames() const { return frames_; }
  /// Returns the GPU milliseconds of the last frame's passes; empty where the queue has no
  /// timestamps.
  const std::vector<gpu::Timer::Span>& timings() const { return timings_; }

  /// Returns the number of shadow rays of the last frame, 0 unless its settings count them.
  std::uint64_t shadow_rays() const;

  /// Returns the mean so far in cd/m^2, denoised where the settings ask for it, with its ImageInfo.
  /// With `layers`, adds the layer "luminance"; where the settings keep layers, "direct_lamps",
  /// "direct_windows", "direct_vehicles", "sky", "emitted" and "indirect"; and of the last frame
  /// "albedo", "normal", "depth" (m), "motion", "position" (m), "material" and "feature" (ids, -1 =
  /// none).
  measure::Image download(bool layers = true) const;
  /// Returns the displayed picture, which every frame writes: width * height words, R in the low
  /// byte.
  const gpu::Buffer& display() const { return display_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  PassConstants constants_of(const RenderSettings& settings) const;
  // The steps of render_frame. check throws UsageError.
  void check(const RenderSettings& settings) const;
  void restart_if_changed(const scene::CameraPose& pose, const RenderSettings& settings);
  void fill_buffers(gpu::Frame& frame, const RenderSettings& settings);
  void fill_view(gpu::Frame& frame, const scene::CameraPose& pose, const RenderSettings& settings);
  void fill_sampling(gpu::Frame& frame, const RenderSettings& settings) const;
  void record(const RenderSettings& settings, std::uint32_t slices);
  void record_vehicles(VkCommandBuffer commands);
  std::uint32_t reference_slices(const RenderSettings& settings) const;
  void render_reference(const RenderSettings& settings, std::uint32_t slices);
  void add_reference_paths(const RenderSettings& settings);
  void submit(const std::function<void(VkCommandBuffer)>& record);
  void record_restir(VkCommandBuffer commands, const RenderSettings& settings);
  void record_end(VkCommandBuffer commands, const RenderSettings& settings);
  // Runs one invocation per pixel and slice, then a barrier. The timer books the time since its
  // last mark under `name`.
  template <class Pass>
  void run_pass(VkCommandBuffer commands, const Pass& pass, const char* name,
                std::uint32_t first = 0, std::uint32_t count = 0, std::uint32_t slices = 1);

  gpu::Device& device_;
  PassLibrary& library_;
  DeviceScene& scene_;
  std::uint32_t width_, height_;
  gpu::Timer timer_;
  VehiclePasses vehicle_passes_;
  IrradianceCache cache_;
  gpu::Buffer frame_;
  gpu::Buffer surfaces_[2], reservoirs_, spatial_[2], radiance_, accumulation_[2], display_;
  // Allocated when first needed.
  gpu::Buffer layers_, denoise_[2], pair_partners_, pair_targets_, path_, ray_count_;
  const PassSet* passes_ = nullptr;  // for the current settings
  std::optional<scene::CameraPose> pose_;
  gpu::Camera camera_{};
  RenderSettings settings_;
  std::uint64_t lit_ = 0;     // address of the last frame's light switches
  std::uint32_t parity_ = 0;  // which of the paired buffers this frame writes
  std::uint32_t frames_ = 0;
  std::uint32_t frame_number_ = 0;  // never repeats, so that frames draw different random numbers
  bool has_history_ = false;
  // The scene's time since the frame before, where its light changes with time.
  double moved_s_ = 0;
  std::vector<gpu::Timer::Span> timings_;
};

}  // namespace nightcity::render
