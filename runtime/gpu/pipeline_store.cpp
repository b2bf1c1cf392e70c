#include "runtime/gpu/pipeline_store.h"

#include <cstdlib>
#include <cstring>
#include <exception>
#include <system_error>

#include "formats/atomic_file.h"
#include "formats/checksum.h"
#include "formats/mapped_file.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {
namespace {

constexpr char magic[8] = {'N', 'C', 'P', 'I', 'P', 'E', 'S', '1'};
// A driver is not given more than this: a set of passes takes a few MB.
constexpr std::size_t max_bytes = std::size_t{1} << 28;

// A file is the magic number, the checksum of the rest, the key and the driver's own data.
constexpr std::size_t head_bytes = sizeof magic + sizeof(std::uint64_t);

std::string to_hex(const std::uint8_t* bytes, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    for (const int shift : {4, 0}) text += "0123456789abcdef"[bytes[i] >> shift & 15];
  return text;
}

std::string find_key(VkPhysicalDevice physical) {
  VkPhysicalDeviceIDProperties ids{};
  ids.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &ids;
  vkGetPhysicalDeviceProperties2(physical, &properties);
  const VkPhysicalDeviceProperties& p = properties.properties;
  return std::to_string(p.vendorID) + "-" + std::to_string(p.deviceID) + "-" +
         std::to_string(p.driverVersion) + "-" + to_hex(ids.driverUUID, VK_UUID_SIZE) + "-" +
         to_hex(p.pipelineCacheUUID, VK_UUID_SIZE);
}

// Returns the driver's data in a file, nothing unless all of it fits.
std::vector<std::byte> read_store(const std::filesystem::path& path, const std::string& key) {
  try {
    const MappedFile file(path);
    const auto bytes = file.bytes();
    if (bytes.size() < head_bytes + key.size() || bytes.size() > max_bytes ||
        std::memcmp(bytes.data(), magic, sizeof magic) != 0)
      return {};
    std::uint64_t sum;
    std::memcpy(&sum, bytes.data() + sizeof magic, sizeof sum);
    const auto rest = bytes.subspan(head_bytes);
    if (sum != checksum(rest.data(), rest.size()) ||
        std::memcmp(rest.data(), key.data(), key.size()) != 0)
      return {};
    return {rest.begin() + static_cast<std::ptrdiff_t>(key.size()), rest.end()};
  } catch (const std::exception&) {
    return {};  // absent or unreadable: the shaders are compiled
  }
}

}  // namespace

std::filesystem::path find_cache_folder() {
  const auto folder_in = [](const char* variable) -> std::filesystem::path {
    const char* value = std::getenv(variable);
    return value && *value == '/' ? value : "";
  };
  std::filesystem::path folder = folder_in("XDG_CACHE_HOME");
  if (folder.empty())
    if (folder = folder_in("HOME"); !folder.empty()) folder /= ".cache";
  return folder.empty() ? folder : folder / "nightcity";
}

PipelineStore::PipelineStore(VkPhysicalDevice physical, VkDevice device,
                             const std::filesystem::path& folder)
    : device_(device) {
  if (!folder.empty()) {
    key_ = find_key(physical);
    file_ = folder / ("pipelines-" + key_);
    read_ = read_store(file_, key_);
  }
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = read_.size();
  info.pInitialData = read_.empty() ? nullptr : read_.data();
  if (vkCreatePipelineCache(device, &info, nullptr, &cache_) == VK_SUCCESS) return;
  read_.clear();
  info.initialDataSize = 0;
  info.pInitialData = nullptr;
  VK_CHECK(vkCreatePipelineCache(device, &info, nullptr, &cache_));
}

PipelineStore::~PipelineStore() {
  try {
    save();
  } catch (const std::exception&) {
    // A full disk or a folder that may not be written to: the next start compiles again.
  }
  vkDestroyPipelineCache(device_, cache_, nullptr);
}

void PipelineStore::save() const {
  if (file_.empty()) return;
  std::size_t size = 0;
  VK_CHECK(vkGetPipelineCacheData(device_, cache_, &size, nullptr));
  std::vector<std::byte> data(size);
  VK_CHECK(vkGetPipelineCacheData(device_, cache_, &size, data.data()));
  data.resize(size);
  if (data.empty() || data == read_ || head_bytes + key_.size() + size > max_bytes) return;
  const auto* key = reinterpret_cast<const std::byte*>(key_.data());
  data.insert(data.begin(), key, key + key_.size());
  const std::uint64_t sum = checksum(data.data(), data.size());
  std::filesystem::create_directories(file_.parent_path());
  AtomicFile file(file_);
  file.write(magic, sizeof magic);
  file.write(&sum, sizeof sum);
  file.write(data.data(), data.size());
  file.commit();
}

}  // namespace nightcity::gpu
