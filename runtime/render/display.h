// The way from a mean in cd/m^2 to the 8-bit picture that is looked at, with what an eye or a
// camera adds to it. Measurements do not go this way.
#pragma once

#include <string>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/device.h"
#include "runtime/measure/image.h"
#include "runtime/render/pass_library.h"
#include "runtime/render/settings.h"

namespace nightcity::render {

/// Returns whether an eye or a camera adds something to the picture: glare, another white, rods.
bool has_eye(const DisplaySettings& display);

/// Returns the same in words, as pictures carry it; "" for nothing.
std::string describe_eye(const DisplaySettings& display);

class Display {
 public:
  /// Device and passes must outlive the display.
  Display(gpu::Device& device, PassLibrary& passes) : device_(device), library_(passes) {}

  /// Writes frame.display from frame.accumulation, both of frame.size pixels; the rest of `frame`
  /// may be empty. `pixel_rad` is the angle of a pixel in the picture's middle. Throws Error when
  /// the device has too little memory.
  void show(gpu::Frame frame, const DisplaySettings& display, double pixel_rad);

  /// Returns a picture as it is looked at.
  measure::Image8 develop(const measure::Image& image, const DisplaySettings& display,
                          double pixel_rad);

 private:
  void fill_glare(gpu::Frame& frame, const DisplaySettings& display, double pixel_rad);

  gpu::Device& device_;
  PassLibrary& library_;
  gpu::Buffer frame_, glare_;
};

/// Sets what the display's passes read of the settings.
void fill_display(gpu::Frame& frame, const DisplaySettings& display);

}  // namespace nightcity::render
