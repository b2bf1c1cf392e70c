#include "runtime/viewer/swapchain.h"

#include <algorithm>

#include "formats/error.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::viewer {
namespace {

constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT;

VkSurfaceFormatKHR choose_format(VkPhysicalDevice physical, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  VK_CHECK(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, nullptr));
  std::vector<VkSurfaceFormatKHR> formats(count);
  VK_CHECK(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, formats.data()));
  // The picture already holds sRGB code values, so the format must not encode them again.
  for (const VkSurfaceFormatKHR& format : formats)
    if (format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM)
      return format;
  throw Error("window", "the window system takes no 8-bit pictures");
}

void check_support(gpu::Device& device, VkSurfaceKHR surface) {
  VkBool32 presents = VK_FALSE;
  VK_CHECK(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical(), device.queue_family(), surface,
                                                &presents));
  if (!presents)
    throw Error(
        "window",
        "device '" + device.info().name +
            "' cannot show pictures in this window; --device chooses another (see nightview "
            "devices)");
}

}  // namespace

Swapchain::Swapchain(gpu::Device& device, VkSurfaceKHR surface)
    : device_(device), surface_(surface) {
  try {
    format_.format = gpu::Image::format;
    if (surface) {
      check_support(device, surface);
      format_ = choose_format(device.physical(), surface);
    }
    create_overlay_pass();
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VK_CHECK(vkCreateFence(device.handle(), &fence, nullptr, &acquired_));
    VK_CHECK(vkCreateFence(device.handle(), &fence, nullptr, &finished_));
  } catch (...) {
    release();
    throw;
  }
}

Swapchain::~Swapchain() {
  vkDeviceWaitIdle(device_.handle());
  release();
}

void Swapchain::release() {
  release_images();
  vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
  vkDestroyRenderPass(device_.handle(), overlay_pass_, nullptr);
  vkDestroyFence(device_.handle(), acquired_, nullptr);
  vkDestroyFence(device_.handle(), finished_, nullptr);
  vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

void Swapchain::create_overlay_pass() {
  VkAttachmentDescription colour{};
  colour.format = format_.format;
  colour.samples = VK_SAMPLE_COUNT_1_BIT;
  colour.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  colour.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  colour.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  colour.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  colour.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = 1;
  info.pAttachments = &colour;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  VK_CHECK(vkCreateRenderPass(device_.handle(), &info, nullptr, &overlay_pass_));
}

void Swapchain::release_images() {
  for (const VkFramebuffer framebuffer : framebuffers_)
    vkDestroyFramebuffer(device_.handle(), framebuffer, nullptr);
  for (const VkImageView view : views_) vkDestroyImageView(device_.handle(), view, nullptr);
  for (const VkSemaphore semaphore : drawn_)
    vkDestroySemaphore(device_.handle(), semaphore, nullptr);
  framebuffers_.clear();
  views_.clear();
  drawn_.clear();
  images_.clear();
}

void Swapchain::resize(glm::uvec2 size) {
  {
    const std::lock_guard lock(device_.queue_mutex());
    VK_CHECK(vkDeviceWaitIdle(device_.handle()));
  }
  release_images();
  if (surface_) {
    create_swapchain(size);
  } else {
    size_ = glm::max(size, glm::uvec2(1));
    for (gpu::Image& image : unseen_) {
      image = gpu::Image(device_, size_, usage);
      images_.push_back(image.handle());
    }
  }
  create_framebuffers();
}

void Swapchain::create_swapchain(glm::uvec2 size) {
  VkSurfaceCapabilitiesKHR able{};
  VK_CHECK(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &able));
  if ((able.supportedUsageFlags & usage) != usage)
    throw Error("window",
                "device '" + device_.info().name + "' cannot copy pictures into this window");
  // Most window systems give the size; some let the program choose.
  if (able.currentExtent.width != 0xFFFFFFFFu)
    size = {able.currentExtent.width, able.currentExtent.height};
  size_ = {std::clamp(size.x, able.minImageExtent.width, able.maxImageExtent.width),
           std::clamp(size.y, able.minImageExtent.height, able.maxImageExtent.height)};

  VkSwapchainCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
  info.surface = surface_;
  info.minImageCount = std::max(2u, able.minImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = {size_.x, size_.y};
  info.imageArrayLayers = 1;
  info.imageUsage = usage;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = able.currentTransform;
  info.compositeAlpha = able.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;  // the only mode that every device has
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_;
  VkSwapchainKHR fresh = VK_NULL_HANDLE;
  VK_CHECK(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &fresh));
  vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
  swapchain_ = fresh;

  std::uint32_t count = 0;
  VK_CHECK(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr));
  images_.resize(count);
  VK_CHECK(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images_.data()));
}

void Swapchain::create_framebuffers() {
  for (const VkImage image : images_) {
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_.format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VK_CHECK(vkCreateImageView(device_.handle(), &view, nullptr, &views_.emplace_back()));
    VkFramebufferCreateInfo frame{};
    frame.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    frame.renderPass = overlay_pass_;
    frame.attachmentCount = 1;
    frame.pAttachments = &views_.back();
    frame.width = size_.x;
    frame.height = size_.y;
    frame.layers = 1;
    VK_CHECK(vkCreateFramebuffer(device_.handle(), &frame, nullptr, &framebuffers_.emplace_back()));
    VkSemaphoreCreateInfo semaphore{};
    semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VK_CHECK(vkCreateSemaphore(device_.handle(), &semaphore, nullptr, &drawn_.emplace_back()));
  }
}

bool Swapchain::acquire() {
  if (images_.empty()) return false;
  if (!surface_) {
    current_ = (current_ + 1) % images();
    return true;
  }
  const VkResult result = vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX,
                                                VK_NULL_HANDLE, acquired_, &current_);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) return false;
  if (result != VK_SUBOPTIMAL_KHR) gpu::check(result, "vkAcquireNextImageKHR");
  VK_CHECK(vkWaitForFences(device_.handle(), 1, &acquired_, VK_TRUE, UINT64_MAX));
  VK_CHECK(vkResetFences(device_.handle(), 1, &acquired_));
  return true;
}

bool Swapchain::present(VkCommandBuffer commands) {
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  submit.signalSemaphoreCount = surface_ ? 1 : 0;
  submit.pSignalSemaphores = &drawn_[current_];
  VkPresentInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &drawn_[current_];
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain_;
  info.pImageIndices = &current_;
  const VkResult result = [&] {
    const std::lock_guard lock(device_.queue_mutex());
    VK_CHECK(vkQueueSubmit(device_.queue(), 1, &submit, finished_));
    return surface_ ? vkQueuePresentKHR(device_.queue(), &info) : VK_SUCCESS;
  }();
  VK_CHECK(vkWaitForFences(device_.handle(), 1, &finished_, VK_TRUE, UINT64_MAX));
  VK_CHECK(vkResetFences(device_.handle(), 1, &finished_));
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
  gpu::check(result, "vkQueuePresentKHR");
  return true;
}

}  // namespace nightcity::viewer
