// The buffers that one frame leaves for the next and for the screen.
#pragma once

#include <glm/vec2.hpp>

#include "runtime/gpu/buffer.h"
#include "shaders/frame.h"
#include "shaders/limits.h"

namespace nightcity::render {

/// Makes `buffer` hold at least `bytes`. What it held is lost where it grows.
inline void fit(gpu::Device& device, gpu::Buffer& buffer, std::size_t bytes) {
  if (buffer.bytes() >= bytes && buffer.address() != 0) return;
  buffer = {};  // frees its memory before the new one allocates
  buffer = gpu::Buffer(device, bytes);
}

struct PictureBuffers {
  glm::uvec2 size{0};
  gpu::Buffer surfaces, spatial, accumulation;
  gpu::Buffer pixel_blocks;
  gpu::Buffer hits;     // where frames keep them
  gpu::Buffer display;  // 8-bit sRGB, R in the low byte

  std::size_t pixels() const { return std::size_t{size.x} * size.y; }
  std::size_t blocks() const {
    const glm::uvec2 blocks = (size + glm::uvec2(WORKGROUP_SIZE - 1)) / glm::uvec2(WORKGROUP_SIZE);
    return std::size_t{blocks.x} * blocks.y;
  }
  void set_size(gpu::Device& device, glm::uvec2 wanted) {
    size = wanted;
    fit(device, surfaces, pixels() * sizeof(gpu::Surface));
    fit(device, spatial, pixels() * sizeof(gpu::Reservoir));
    fit(device, accumulation, pixels() * sizeof(gpu::Accumulation));
    fit(device, pixel_blocks, blocks() * sizeof(gpu::PixelBlock));
    fit(device, display, pixels() * sizeof(std::uint32_t));
  }
};

}  // namespace nightcity::render
