// The picture of the window: rendered in slices, refined while the view rests, exposed by its own
// light.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "runtime/render/renderer.h"
#include "runtime/viewer/metering.h"
#include "runtime/viewer/pace.h"
#include "runtime/viewer/refinement.h"

namespace nightcity::viewer {

/// The picture is to show this.
struct View {
  scene::CameraPose pose;
  render::RenderSettings settings;
  glm::uvec2 window{1, 1};             // pixels
  std::uint32_t divisor = 0;           // as Refinement::set_divisor takes it
  std::uint32_t max_frames = 0;        // in the mean
  bool runs = false;                   // the clock runs
  bool switches = false;               // lights will be switched soon: DeviceScene::switching()
  render::GovernorOptions governor{};  // of frames while the view moves or the clock runs
};

/// Begins to compile the passes of the first picture of a scene, which it has first where they are
/// not all there.
void start_first_passes(render::PassLibrary& passes, const render::RenderSettings& settings,
                        const scene::SceneTraits& traits);

class LivePicture {
 public:
  LivePicture(gpu::Device& device, render::PassLibrary& passes, render::DeviceScene& scene,
              glm::uvec2 window);

  /// Works at the picture, and waits at most `wait_s` for the device. Returns whether a frame was
  /// completed. Camera and settings may change at every call: a frame that takes long is then given
  /// up, a short one is shown first.
  bool work(const View& view, double now_s, double wait_s);
  /// Returns whether work() would do nothing: all frames of the mean are there.
  bool rests(const View& view, double now_s) const;
  /// Returns whether the picture on the screen, however coarse, is of this view, and no draft.
  bool shows(const View& view) const;
  /// Returns whether a slice runs on the device: showing a picture would wait for it.
  bool is_busy() const { return renderer_.is_busy() || pace_.is_busy(); }
  bool has_begun() const { return renderer_.has_begun(); }
  /// Returns whether shaders for these settings are still being compiled.
  bool compiles() const { return compiles_; }
  /// Waits at most `wait_s` for the slice that runs, and returns whether none does.
  bool wait(double wait_s) { return renderer_.wait(wait_s) && pace_.wait(wait_s); }
  /// Waits for the slice that runs, if any, and gives up the frame that has begun.
  void stop() {
    renderer_.abandon_frame();
    pace_.stop();
  }

  /// Shows the last picture with these settings of the display, if it has others. VIEW_DIFFERENCE
  /// compares it with `reference`, once that is of the same view, and else is the picture. Not
  /// while is_busy().
  void expose(const render::DisplaySettings& display, const LivePicture* reference = nullptr);
  /// Returns whether both pictures are there and show the same from the same place.
  bool is_like(const LivePicture& other) const;
  /// Returns the exposure that the picture on the screen asks for, and its light.
  Metered meter() const;

  /// Returns the luminance that the picture on the screen has where it shows `point`, cd/m2;
  /// nothing where it does not. Not while is_busy().
  std::optional<double> luminance_at(const glm::vec3& point) const;

  bool has_picture() const { return renderer_.frames() > 0; }
  /// Returns whether the picture on the screen is a draft (render::to_draft): there were no passes
  /// for more.
  bool is_draft() const { return has_picture() && shown_effort_.draft; }
  const render::Renderer& renderer() const { return renderer_; }
  /// Returns the settings that the picture on the screen was made with: those of its view, within
  /// the bounds of a quick frame.
  render::RenderSettings made_with() const;
  /// Returns the plan of the last complete frame.
  const FramePlan& shown() const { return shown_plan_; }
  /// Returns whether that frame was begun while the view moved or its clock ran.
  bool was_in_motion() const { return shown_moves_; }
  /// Returns how frames keep to their budget, or how far that is measured.
  const Pace& pace() const { return pace_; }
  bool is_fine() const { return refinement_.is_fine(); }
  double share_done() const { return renderer_.share_done(); }
  /// Returns the size that the frame in progress, or else the last one, has as its divisor.
  const FramePlan& plan() const { return plan_; }

 private:
  void notice_changes(const View& view, double now_s);
  void begin(const View& view, double now_s);
  // Returns whether the passes for the next frame are compiled, and decides whether it is a draft.
  bool find_passes(const View& view);
  void complete(const View& view);

  const gpu::Device& device_;
  render::Renderer renderer_;
  Refinement refinement_;
  Pace pace_;
  std::optional<View> view_;  // at the last call
  View begun_;                // of the frame in progress
  render::Effort effort_, shown_effort_;
  bool drafts_ = false;       // the frame in progress
  bool moves_ = false;        // the view, when the frame in progress was begun
  bool is_governed_ = false;  // the frame in progress
  FramePlan plan_, shown_plan_;
  bool shown_moves_ = false;
  std::optional<View> shown_;  // of the last complete frame
  render::DisplaySettings shown_display_;
  std::uint64_t completed_ = 0;      // frames
  std::uint64_t compared_with_ = 0;  // completed_ of the reference, 0 without one
  bool display_changed_ = false;     // in a way that only rendering shows
  bool compiles_ = false;
};

}  // namespace nightcity::viewer
