// Renders a scene frame by frame on a device and keeps the running mean of the frames.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
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
#include "runtime/render/display.h"
#include "runtime/render/frame_run.h"
#include "runtime/render/irradiance_cache.h"
#include "runtime/render/pass_constants.h"
#include "runtime/render/pass_library.h"
#include "runtime/render/picture_buffers.h"
#include "runtime/render/settings.h"
#include "runtime/render/vehicle_passes.h"
#include "runtime/scene/camera.h"

namespace nightcity::render {

/// Bounds of a frame's samples below what the settings ask for: a first look takes a third of the
/// time. The estimate stays unbiased, and its reservoirs serve later frames.
struct Effort {
  std::uint32_t max_candidates = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t max_neighbours = std::numeric_limits<std::uint32_t>::max();
  // A cell of the irradiance cache gets no more paths than these, new ones included.
  std::uint32_t max_cell_paths = std::numeric_limits<std::uint32_t>::max();
  // Times the side of these cells: 1 or more.
  float cell_scale = 1;
  // Times the settings' resolution scale: 0.1 .. 1.
  float resolution_scale = 1;
  bool half_rate = false;  // even where the settings do not ask for it
  // Renders with to_draft(settings), and leaves no trace in later frames.
  bool draft = false;

  bool operator==(const Effort&) const = default;
};

class Renderer {
 public:
  /// Device, passes and scene must outlive the renderer. Throws Error when the device has too
  /// little memory, UsageError when a side is 0 or above max_image_side.
  Renderer(gpu::Device& device, PassLibrary& passes, DeviceScene& scene, std::uint32_t width,
           std::uint32_t height);

  /// Renders one frame and adds it to the mean. The mean starts anew when the camera, the time, the
  /// size, the effort or a setting that have_same_estimate compares has changed since the last
  /// frame. Reservoirs are reprojected where only the camera, the time, the size or the effort
  /// changed, else discarded. Switches the scene's lights to the settings' time. Throws UsageError
  /// when a setting is out of range.
  void render_frame(const scene::CameraPose& pose, const RenderSettings& settings);

  /// The same in slices: begin_frame(), then continue_frame() until it returns true. Until then,
  /// everything that the renderer returns is of the frame before. A frame that has begun is given
  /// up by begin_frame() or abandon_frame().
  void begin_frame(const scene::CameraPose& pose, const RenderSettings& settings,
                   const Effort& effort = {});
  /// Submits about `slice_s` of work, unless work is submitted, and waits for it at most `wait_s`.
  /// Returns whether the frame is complete.
  bool continue_frame(double slice_s, double wait_s);
  /// Waits at most `wait_s` for the slice that is submitted, and returns whether none is.
  bool wait(double wait_s) { return run_.wait(wait_s); }
  /// Returns whether the begun frame needs only a continue_frame() to be shown.
  bool is_complete() const { return begun_ && run_.is_done(); }
  /// Gives up the frame that has begun, if any.
  void abandon_frame();
  bool has_begun() const { return begun_; }
  /// Returns whether a slice is submitted: whoever uses the device now waits for its end.
  bool is_busy() const { return run_.is_submitted(); }
  /// Returns the share of the begun frame that is done, 0 .. 1.
  double share_done() const { return begun_ ? run_.share_done() : 0; }
  /// Returns the seconds that the device worked at the last complete frame.
  double frame_s() const { return frame_s_; }

  /// Sets the picture's size from the next frame on. A frame has fewer pixels where its settings or
  /// effort scale the resolution. Throws as the constructor does.
  void set_size(std::uint32_t width, std::uint32_t height);

  /// Shows the mean with another exposure or tone curve, or another view of it: rewrites display(),
  /// which is the picture as every frame leaves it. A view that needs layers or hits shows the
  /// picture where the frame kept none, and so does VIEW_DIFFERENCE without a `reference`, the
  /// renderer of the same view by the reference estimator.
  void expose(const DisplaySettings& display, const Renderer* reference = nullptr);
  /// Returns a picture of the last frame's camera as it is looked at, with what an eye or a camera
  /// adds. The device must not be at work on a frame.
  measure::Image8 develop(const measure::Image& image, const DisplaySettings& display);

  /// Returns whether the passes for these settings are compiled. If not, they are being compiled in
  /// the background.
  bool is_ready(const RenderSettings& settings) {
    return library_.is_ready(find_constants(settings, scene_.traits()));
  }
  /// Returns whether they are, and compiles nothing.
  bool has_passes(const RenderSettings& settings) {
    return library_.has(find_constants(settings, scene_.traits()));
  }
  /// As is_ready(), of the passes for a draft.
  bool is_draft_ready(const RenderSettings& settings) {
    return library_.is_ready(find_constants(to_draft(settings), scene_.traits()), Extent::draft);
  }

  std::vector<Feature> list_unneeded(const RenderSettings& settings) const {
    return render::list_unneeded(settings, scene_);
  }

  /// Returns the number of frames in the mean.
  std::uint32_t frames() const { return done_.frames; }
  /// Returns the GPU milliseconds of the last frame's passes; empty where the queue has no
  /// timestamps.
  const std::vector<gpu::Timer::Span>& timings() const { return timings_; }

  /// Returns the number of shadow rays of the last frame, 0 unless its settings count them.
  std::uint64_t shadow_rays() const;

  /// Returns the mean so far in cd/m^2, upscaled to the picture's size where frames have fewer
  /// pixels, denoised where the settings ask for it, with its ImageInfo.
  /// With `layers`, adds the layer "luminance"; where the settings keep layers, "direct_lamps",
  /// "direct_windows", "direct_vehicles", "sky", "emitted", "indirect" and "air"; and of the last
  /// frame "albedo", "normal", "depth" (m), "motion", "position" (m), "material" and "feature"
  /// (ids, -1 = none).
  measure::Image download(bool layers = true) const;
  /// Returns a part of the mean that is enough to meter the exposure: evenly spaced rows, about
  /// `pixels` in all, with the layers "emitter": 1 where a luminous surface is seen, else 0; and
  /// "light": the number of its light (rounded beyond 2^24), -1 elsewhere.
  measure::Image sample_mean(std::size_t pixels) const;
  /// Returns the mean at a pixel, cd/m^2.
  glm::vec3 mean_at(glm::uvec2 pixel) const;
  /// Returns the displayed picture: width * height words, R in the low byte.
  const gpu::Buffer& display() const { return pictures_[parity_].display; }
  /// The size of frames: of the last one. That of the picture is at least as large.
  std::uint32_t width() const { return pictures_[parity_].size.x; }
  std::uint32_t height() const { return pictures_[parity_].size.y; }
  glm::uvec2 picture_size() const { return picture_size_; }

 private:
  // A complete frame leaves this for the next.
  struct State {
    std::optional<scene::CameraPose> pose;
    gpu::Camera camera{};
    gpu::Air air{};
    RenderSettings settings;
    Effort effort;
    std::uint64_t lit = 0;            // address of the light switches
    std::uint32_t light_changes = 0;  // DeviceScene::light_changes() then
    std::uint32_t frames = 0;
    bool has_history = false;
    std::uint32_t age = 0;  // frames since there was no history
    // Light that shows as one step of an 8-bit picture at the metered exposure, cd/m^2; 0 = not
    // metered yet.
    float step_cd_m2 = 0;
  };

  // The steps of begin_frame. check throws UsageError.
  void check(const RenderSettings& settings) const;
  void restart_if_changed();
  void fill_buffers(gpu::Frame& frame, const RenderSettings& settings);
  void fill_view(gpu::Frame& frame);
  // Writes the display from a view other than the picture.
  void inspect(gpu::Frame& frame, const DisplaySettings& display, const Renderer* reference);
  void finish_frame();
  // Meters what Russian roulette takes for faint, now and then: it need not be exact.
  void meter_faint();
  // Returns whether the last frame has fewer pixels than the picture.
  bool is_scaled() const {
    return done_.settings.sampling.resolution_scale * done_.effort.resolution_scale < 1;
  }
  measure::ImageInfo describe_picture() const;

  gpu::Device& device_;
  PassLibrary& library_;
  DeviceScene& scene_;
  VehiclePasses vehicle_passes_;
  IrradianceCache cache_;
  gpu::Buffer frame_, exposed_frame_;
  Display display_;
  PictureBuffers pictures_[2];  // of the last complete frame (parity_) and of the other
  gpu::Buffer reservoirs_, radiance_;
  // Allocated when first needed.
  gpu::Buffer layers_, denoise_[2], denoised_, pair_partners_, pair_samples_, path_, ray_count_;
  std::shared_ptr<const PassSet> passes_;  // of the begun frame, then of the last complete one
  glm::uvec2 picture_size_;                // that is asked for
  glm::uvec2 size_;                        // of the next frame
  State done_, next_;
  std::uint32_t parity_ = 0;
  std::uint32_t frame_number_ = 0;  // never repeats, so that frames draw different random numbers
  bool begun_ = false;
  double frame_s_ = 0;
  // The scene's time since the frame before, where its light changes with time.
  double moved_s_ = 0;
  std::vector<gpu::Timer::Span> timings_;
  // Declared last, so destroyed first: it waits for the device, which may be using all of the
  // above.
  FrameRun run_;
};

}  // namespace nightcity::render
