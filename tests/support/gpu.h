// A Vulkan device for tests: by default the CPU driver, under the validation layer, which must
// report nothing.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "runtime/gpu/device.h"
#include "runtime/render/renderer.h"

namespace nightcity::test {

/// Returns the device that all tests of a program share. NIGHTCITY_TEST_DEVICE names another
/// device, NIGHTCITY_TEST_TRACE (query, pipeline) another way to trace rays.
inline gpu::Device& test_device() {
  static gpu::Device device([] {
    gpu::Device::Options options;
    if (const char* name = std::getenv("NIGHTCITY_TEST_DEVICE")) options.select = name;
    if (const char* name = std::getenv("NIGHTCITY_TEST_TRACE"))
      options.trace = gpu::trace_from_name(name);
    options.validation = std::getenv("NIGHTCITY_TEST_NO_VALIDATION") == nullptr;
    return options;
  }());
  return device;
}

/// Returns the compiled passes, which all tests of a program share: compiling takes a while.
inline render::PassLibrary& test_passes() {
  static render::PassLibrary passes(test_device());
  return passes;
}

/// Returns the mean of `frames` frames. Fails the test when the validation layer reports anything.
inline measure::Image render(const scene::RenderScene& scene, const scene::CameraPose& pose,
                             const render::RenderSettings& settings, std::uint32_t width,
                             std::uint32_t height, std::uint32_t frames) {
  gpu::Device& device = test_device();
  const std::size_t before = device.validation_messages().size();
  render::DeviceScene device_scene(device, scene);
  render::Renderer renderer(device, test_passes(), device_scene, width, height);
  for (std::uint32_t i = 0; i < frames; ++i) renderer.render_frame(pose, settings);
  measure::Image image = renderer.download();
  for (std::size_t i = before; i < device.validation_messages().size(); ++i)
    ADD_FAILURE() << "validation layer: " << device.validation_messages()[i];
  return image;
}

inline double luminance(const measure::Image& image, std::size_t pixel) {
  return 0.2126 * double(image.rgb[3 * pixel]) + 0.7152 * double(image.rgb[3 * pixel + 1]) +
         0.0722 * double(image.rgb[3 * pixel + 2]);
}

inline double mean_luminance(const measure::Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) sum += luminance(image, i);
  return sum / double(image.pixels());
}

}  // namespace nightcity::test
