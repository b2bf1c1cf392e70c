#include "runtime/render/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/vector_relational.hpp>
#include <vector>

#include "runtime/measure/exposure.h"
#include "runtime/render/glare.h"
#include "runtime/render/picture_buffers.h"
#include "runtime/render/white.h"

namespace nightcity::render {
namespace {

bool changes_white(const DisplaySettings& display) {
  return display.white_balance_k > 0 || display.adapt_white;
}

PassConstants constants_of(const DisplaySettings& display) {
  PassConstants constants{};
  constants[CONSTANT_GLARE] = display.glare_age > 0;
  constants[CONSTANT_WHITE] = changes_white(display);
  constants[CONSTANT_MESOPIC] = display.mesopic;
  return constants;
}

}  // namespace

bool has_eye(const DisplaySettings& display) {
  return display.glare_age > 0 || changes_white(display) || display.mesopic;
}

std::string describe_eye(const DisplaySettings& display) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (display.glare_age > 0) add(fmt::format("glare of an eye of {:g} years", display.glare_age));
  if (display.white_balance_k > 0)
    add(fmt::format("white of {:g} K", display.white_balance_k));
  else if (display.adapt_white)
    add("white adapted to the scene");
  if (display.mesopic) add("mesopic colours");
  return text;
}

void fill_display(gpu::Frame& frame, const DisplaySettings& display) {
  frame.exposure = tonemap::exposure_scale(display.ev100);
  frame.tone = display.tone;
  frame.view = display.view;
  frame.view_lowest = display.view_lowest;
  frame.view_highest = display.view_highest;
}

void Display::fill_glare(gpu::Frame& frame, const DisplaySettings& display, double pixel_rad) {
  gpu::Glare& glare = frame.glare;
  glare.size[0] = frame.size;
  std::size_t pixels = 0;
  // The last level is a few pixels large: it spreads light over the whole picture.
  do {
    const glm::uvec2 below = glare.size[glare.last++];
    glare.size[glare.last] = (below + 1u) / 2u;
    glare.first[glare.last] = static_cast<std::uint32_t>(pixels);
    pixels += std::size_t{glare.size[glare.last].x} * glare.size[glare.last].y;
  } while (glm::any(glm::greaterThan(glare.size[glare.last], glm::uvec2(2))) &&
           glare.last + 1 < MAX_GLARE_LEVELS);
  fit(device_, glare_, pixels * sizeof(glm::vec3));
  glare.levels = glare_.address();
  const std::vector<double> weights =
      glare_weights(double{display.glare_age}, pixel_rad, glare.last);
  std::transform(weights.begin(), weights.end(), glare.weight,
                 [](double weight) { return static_cast<float>(weight); });
}

void Display::show(gpu::Frame frame, const DisplaySettings& display, double pixel_rad) {
  if (frame_.bytes() == 0) frame_ = gpu::Buffer(device_, sizeof(gpu::Frame), gpu::Memory::host);
  fill_display(frame, display);
  if (changes_white(display)) {
    const glm::mat3 white = glm::transpose(white_matrix(display));
    frame.white_red = white[0];
    frame.white_green = white[1];
    frame.white_blue = white[2];
  }
  if (display.glare_age > 0) fill_glare(frame, display, pixel_rad);
  frame_.upload(&frame, sizeof frame);
  const DisplayPasses& passes = library_.display(constants_of(display));
  device_.run([&](VkCommandBuffer commands) {
    const auto dispatch = [&](const gpu::ComputePass& pass, std::uint32_t level) {
      const gpu::Push push{frame_.address(), level, 0};
      pass.dispatch(commands, &push, frame.glare.size[level].x, frame.glare.size[level].y);
      gpu::full_barrier(commands);
    };
    const std::uint32_t last = frame.glare.last;  // 0 without glare
    for (std::uint32_t level = 1; level <= last; ++level) dispatch(passes.glare_down, level);
    for (std::uint32_t level = last; level > 0; --level) dispatch(passes.glare_up, level);
    const gpu::Push push{frame_.address(), 0, 0};
    passes.expose.dispatch(commands, &push, frame.size.x, frame.size.y);
    gpu::full_barrier(commands);
  });
}

measure::Image8 Display::develop(const measure::Image& image, const DisplaySettings& display,
                                 double pixel_rad) {
  if (!has_eye(display)) return measure::to_display(image, display.ev100, display.tone);
  const std::size_t pixels = image.pixels();
  std::vector<gpu::Accumulation> means(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    means[i].frames = 1;
    for (int c = 0; c < 3; ++c) {
      const float value = image.rgb[3 * i + std::size_t(c)];
      means[i].sum[c] = std::isfinite(value) ? value : 0;  // one bad pixel would spread over all
    }
  }
  const auto mean = gpu::Buffer::of<gpu::Accumulation>(device_, means);
  const gpu::Buffer shown(device_, pixels * sizeof(std::uint32_t), gpu::Memory::readback);
  gpu::Frame frame{};
  frame.size = {image.width, image.height};
  frame.accumulation = mean.address();
  frame.display = shown.address();
  show(frame, display, pixel_rad);
  measure::Image8 picture{image.width, image.height, std::vector<std::uint8_t>(3 * pixels)};
  const auto words = shown.read<std::uint32_t>(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    for (unsigned c = 0; c < 3; ++c)
      picture.rgb[3 * i + c] = static_cast<std::uint8_t>(words[i] >> 8 * c);
  return picture;
}

}  // namespace nightcity::render
