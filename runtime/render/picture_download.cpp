#include "runtime/render/picture_download.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "runtime/gpu/submission.h"

namespace nightcity::render {

glm::vec3 mean_of(const gpu::Accumulation& sum) {
  return sum.frames > 0 ? (sum.sum - sum.compensation) / sum.frames : glm::vec3(0);
}

measure::Image make_picture(std::span<const gpu::Accumulation> sums, glm::uvec2 size) {
  measure::Image image;
  image.width = size.x;
  image.height = size.y;
  image.rgb.reserve(3 * sums.size());
  for (const gpu::Accumulation& sum : sums) {
    const glm::vec3 mean = mean_of(sum);
    image.rgb.insert(image.rgb.end(), {mean.x, mean.y, mean.z});
  }
  return image;
}

measure::Image sample_picture(gpu::Device& device, const PictureBuffers& picture,
                              std::size_t pixels) {
  const std::size_t rows = std::clamp<std::size_t>(pixels / picture.size.x, 1, picture.size.y);
  const std::size_t row_bytes = picture.size.x * sizeof(gpu::Accumulation);
  const std::size_t surface_bytes = picture.size.x * sizeof(gpu::Surface);
  gpu::Buffer sampled(device, rows * row_bytes, gpu::Memory::readback),
      seen(device, rows * surface_bytes, gpu::Memory::readback);
  std::vector<VkBufferCopy> copies, surface_copies;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t row = picture.size.y * i / rows;
    copies.push_back({row * row_bytes, i * row_bytes, row_bytes});
    surface_copies.push_back({row * surface_bytes, i * surface_bytes, surface_bytes});
  }
  device.run([&](VkCommandBuffer commands) {
    vkCmdCopyBuffer(commands, picture.accumulation.handle(), sampled.handle(),
                    static_cast<std::uint32_t>(copies.size()), copies.data());
    vkCmdCopyBuffer(commands, picture.surfaces.handle(), seen.handle(),
                    static_cast<std::uint32_t>(copies.size()), surface_copies.data());
    gpu::full_barrier(commands);
  });
  const std::size_t count = rows * picture.size.x;
  measure::Image image =
      make_picture({static_cast<const gpu::Accumulation*>(sampled.mapped()), count},
                   {picture.size.x, static_cast<std::uint32_t>(rows)});
  measure::ImageLayer emitters{"emitter", {"E"}, std::vector<float>(count)},
      lights{"light", {"I"}, std::vector<float>(count, -1)};
  const auto* surfaces = static_cast<const gpu::Surface*>(seen.mapped());
  for (std::size_t i = 0; i < count; ++i) {
    if (!(surfaces[i].depth > 0) || surfaces[i].light == NO_HIT) continue;
    emitters.values[i] = 1;
    lights.values[i] = static_cast<float>(surfaces[i].light);
  }
  image.layers.push_back(std::move(emitters));
  image.layers.push_back(std::move(lights));
  return image;
}

}  // namespace nightcity::render
