#include "runtime/viewer/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <fstream>
#include <iterator>

#include "formats/atomic_file.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::viewer {
namespace {

// Latin-1 alone is in Dear ImGui's own font: places and licences have umlauts.
constexpr ImWchar glyphs[] = {0x20, 0xFF, 0};

void check_result(VkResult result) {
  gpu::check(result, "a call of Dear ImGui's");
}

}  // namespace

Overlay::Overlay(gpu::Device& device, const Window& window, const Swapchain& swapchain,
                 float font_px)
    : device_(device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};  // the font
  VkDescriptorPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  pool.maxSets = 1;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  VK_CHECK(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &descriptors_));

  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // see load_places
  // The queue hands over the events, not the backend: see InputQueue.
  ImGui_ImplGlfw_InitForVulkan(window.handle(), false);
  constexpr float standard_px = 13;  // of Dear ImGui's own font
  ImFontConfig font;
  font.SizePixels = font_px;
  font.GlyphRanges = glyphs;
  ImGui::GetIO().Fonts->AddFontDefault(&font);
  ImGui::GetStyle().ScaleAllSizes(font_px / standard_px);
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physical();
  info.Device = device.handle();
  info.QueueFamily = device.queue_family();
  info.Queue = device.queue();
  info.DescriptorPool = descriptors_;
  info.MinImageCount = 2;
  info.ImageCount = swapchain.images();
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = check_result;
  ImGui_ImplVulkan_Init(&info, swapchain.overlay_pass());
  device.run([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

Overlay::~Overlay() {
  vkDeviceWaitIdle(device_.handle());
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  vkDestroyDescriptorPool(device_.handle(), descriptors_, nullptr);
}

void Overlay::load_places(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  if (in) ImGui::LoadIniSettingsFromMemory(text.data(), text.size());
}

void Overlay::save_places(const std::filesystem::path& file) const {
  std::size_t size = 0;
  const char* text = ImGui::SaveIniSettingsToMemory(&size);
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  AtomicFile out(file);
  out.write(text, size);
  out.commit();
}

void Overlay::begin(InputQueue& queue) {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  queue.feed(ImGui::GetIO());
  ImGui::NewFrame();
}

void Overlay::end() {
  ImGui::Render();
}

void Overlay::record(VkCommandBuffer commands) {
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
}

}  // namespace nightcity::viewer
