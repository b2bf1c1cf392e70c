// Chooses the picture to render next: coarse while hands move, then finer and finer until every
// pixel of the window has its own.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace nightcity::viewer {

/// The next frame to render.
struct FramePlan {
  std::uint32_t divisor = 8;  // the picture has 1 / divisor of the window's pixels along each side
  bool quick = true;          // with few samples (quick_effort); else as the settings say

  bool operator==(const FramePlan&) const = default;
};

/// Plans frames from the times of earlier ones. Times are seconds of any clock that does not go
/// back.
class Refinement {
 public:
  /// While the view moves, a frame takes at most this long, where the coarsest can be rendered in
  /// that time.
  static constexpr double moving_frame_s = 0.1;
  /// The view counts as moving until so long after its last change.
  static constexpr double rest_s = 0.25;
  static constexpr std::uint32_t coarsest = 8;

  /// `divisor`: 0 refines, others are kept, with all samples of the settings.
  void set_divisor(std::uint32_t divisor) { fixed_ = divisor; }
  /// Says that camera, time or a setting changed: the picture shown is of something else.
  void change(double now_s);
  /// Says that a frame of `pixels` pixels is complete, how long the device worked at it, and
  /// whether it shows the present view.
  void complete(const FramePlan& plan, double pixels, double seconds, bool is_present);

  /// Returns whether the view counts as moving.
  bool is_moving(double now_s) const { return now_s - changed_s_ < rest_s; }
  /// Returns the next frame for a window of `pixels` pixels. `runs`: the clock runs, so that the
  /// view never rests.
  FramePlan plan(double now_s, double pixels, bool runs) const;
  /// Returns whether a frame of an older view is to be given up: it takes much longer than the
  /// quickest that shows the present one.
  bool is_worth_giving_up(const FramePlan& plan, double pixels) const;
  /// Returns whether the picture last completed shows the present view at every pixel the window
  /// is to have, with all its samples.
  bool is_fine() const;
  /// Returns the seconds that a frame is expected to take, nothing before the first.
  std::optional<double> frame_s(const FramePlan& plan, double pixels) const;

 private:
  FramePlan plan_moving(double pixels) const;

  std::uint32_t fixed_ = 0;
  double changed_s_ = -1e9;
  std::optional<FramePlan> shown_;       // of the present view
  std::array<double, 2> pixel_s_{0, 0};  // seconds a pixel, full and quick; 0 = not known
};

}  // namespace nightcity::viewer
