// The exposure and the white that follow the picture's light.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "runtime/measure/image.h"

namespace nightcity::viewer {

constexpr float min_ev100 = -6, max_ev100 = 16;  // the panel's slider

struct Metered {
  float ev100;      // measure::auto_exposure_ev100, within the slider's range
  glm::vec3 light;  // measure::mean_light
};

Metered meter_picture(const measure::Image& picture);

/// Returns the light that the white is adapted to after a picture was metered: a fifth of the way
/// from the one before, which 0 says is not known. Differences that are not seen are left alone.
glm::vec3 follow_light(const glm::vec3& before, const glm::vec3& metered);

/// Moves the exposure towards what was metered last, as an eye adapts.
class Metering {
 public:
  /// Takes the exposure over at once at the next update: metering was asked for, or another scene
  /// is shown.
  void restart() { jumps_ = true; }
  void set_target(float ev100);
  /// Returns the exposure `elapsed_s` after the last update: nine tenths of the way to the target
  /// in a second. Differences below what an eye sees are left alone, so that noise does not make
  /// the picture flicker.
  float update(float ev100, double elapsed_s);
  /// Returns whether update() will go on changing the exposure without another set_target().
  bool is_moving(float ev100) const;

 private:
  std::optional<float> target_;
  bool jumps_ = true;
};

}  // namespace nightcity::viewer
