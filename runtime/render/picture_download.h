// Pictures on the host from what a frame leaves on the device.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "runtime/gpu/device.h"
#include "runtime/measure/image.h"
#include "runtime/render/picture_buffers.h"

namespace nightcity::render {

/// Returns the mean of the frames that a pixel has summed up, cd/m^2; 0 before the first.
glm::vec3 mean_of(const gpu::Accumulation& sum);

/// Returns the picture of a pixel's sums each, row by row from the top.
measure::Image make_picture(std::span<const gpu::Accumulation> sums, glm::uvec2 size);

/// Returns evenly spaced rows of a picture, about `pixels` in all, with the layers "emitter" and
/// "light" of Renderer::sample_mean().
measure::Image sample_picture(gpu::Device& device, const PictureBuffers& picture,
                              std::size_t pixels);

}  // namespace nightcity::render
