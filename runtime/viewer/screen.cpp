#include "runtime/viewer/screen.h"

#include <algorithm>
#include <cmath>

#include "runtime/gpu/commands.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::viewer {
namespace {

constexpr VkImageSubresourceLayers colour_layer{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

// A barrier between everything before and everything after: a few copies per frame need none finer.
void change_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

VkBufferImageCopy whole(glm::uvec2 size) {
  VkBufferImageCopy copy{};
  copy.imageSubresource = colour_layer;
  copy.imageExtent = {size.x, size.y, 1};
  return copy;
}

VkOffset3D corner(glm::uvec2 size) {
  return {static_cast<std::int32_t>(size.x), static_cast<std::int32_t>(size.y), 1};
}

}  // namespace

Screen::Screen(gpu::Device& device) : device_(device) {
  commands_ = gpu::make_commands(device.handle(), device.queue_family(), pool_);
}

Screen::~Screen() {
  vkDeviceWaitIdle(device_.handle());
  vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

// Leaves the swapchain's image in VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, in which it is.
void Screen::draw(const gpu::Image& held, const ShownPicture& picture, const Swapchain& swapchain) {
  change_layout(commands_, held.handle(), VK_IMAGE_LAYOUT_UNDEFINED,
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  const VkBufferImageCopy copy = whole(picture.size);
  vkCmdCopyBufferToImage(commands_, picture.words->handle(), held.handle(),
                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
  change_layout(commands_, held.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  const glm::uvec2 window = swapchain.size();
  // Whole pixels of the picture, and as many of the window as they take.
  glm::uvec2 from = picture.size, to = window;
  if (picture.width < 1) {
    from.x = static_cast<std::uint32_t>(std::lround(picture.width * float(picture.size.x)));
    to.x = static_cast<std::uint32_t>(
        std::lround(double(from.x) * double(window.x) / double(picture.size.x)));
    if (from.x == 0 || to.x == 0) return;
  }
  VkImageBlit blit{};
  blit.srcSubresource = blit.dstSubresource = colour_layer;
  blit.srcOffsets[1] = corner(from);
  blit.dstOffsets[1] = corner(to);
  vkCmdBlitImage(commands_, held.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, swapchain.image(),
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit,
                 picture.size == window ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
}

bool Screen::show(Swapchain& swapchain, std::span<const ShownPicture> pictures,
                  const std::function<void(VkCommandBuffer)>& overlay, measure::Image8* grab) {
  const std::size_t count = std::min(pictures.size(), max_pictures);
  for (std::size_t i = 0; i < count; ++i)
    if (pictures[i].size != held_[i].size())
      held_[i] = gpu::Image(device_, pictures[i].size,
                            VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  const glm::uvec2 window = swapchain.size();
  const VkImage target = swapchain.image();
  gpu::Buffer grabbed;
  if (grab)
    grabbed = gpu::Buffer(device_, std::size_t{4} * window.x * window.y, gpu::Memory::readback);

  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  VK_CHECK(vkBeginCommandBuffer(commands_, &begin));

  change_layout(commands_, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  for (std::size_t i = 0; i < count; ++i) {
    // Two blits write the same pixels in order.
    if (i > 0)
      change_layout(commands_, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    draw(held_[i], pictures[i], swapchain);
  }
  change_layout(commands_, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  VkRenderPassBeginInfo pass{};
  pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  pass.renderPass = swapchain.overlay_pass();
  pass.framebuffer = swapchain.framebuffer();
  pass.renderArea.extent = {window.x, window.y};
  vkCmdBeginRenderPass(commands_, &pass, VK_SUBPASS_CONTENTS_INLINE);
  overlay(commands_);
  vkCmdEndRenderPass(commands_);

  if (grab) {
    change_layout(commands_, target, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
                  VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy back = whole(window);
    vkCmdCopyImageToBuffer(commands_, target, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           grabbed.handle(), 1, &back);
    change_layout(commands_, target, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                  VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    gpu::full_barrier(commands_);
  }
  VK_CHECK(vkEndCommandBuffer(commands_));
  const bool good = swapchain.present(commands_);

  if (grab) {
    const auto words = grabbed.read<std::uint32_t>(std::size_t{window.x} * window.y);
    const bool blue_first = swapchain.format() == VK_FORMAT_B8G8R8A8_UNORM;
    *grab = {window.x, window.y, std::vector<std::uint8_t>(3 * words.size())};
    for (std::size_t i = 0; i < words.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        grab->rgb[3 * i + (blue_first ? 2 - c : c)] =
            static_cast<std::uint8_t>(words[i] >> (8 * c));
  }
  return good;
}

}  // namespace nightcity::viewer
