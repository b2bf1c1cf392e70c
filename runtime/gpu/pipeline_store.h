// Compiled pipelines kept on disk: a driver takes up to seconds to compile a set of shaders, and
// the next start need not.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nightcity::gpu {

/// Returns nightcity's folder below $XDG_CACHE_HOME or, where that is no absolute path, below
/// $HOME/.cache (XDG Base Directory Specification 0.8); "" where neither is set.
std::filesystem::path find_cache_folder();

/// A VkPipelineCache that is read from a file when it is made, and written back when it is
/// destroyed if it has grown. The file's name and head say which device and driver it is for. A
/// file of another device or driver, or that is damaged, counts as absent and is replaced. A folder
/// that cannot be read or written costs only the time to compile.
class PipelineStore {
 public:
  /// `folder` is made when it is needed; "": nothing is kept.
  PipelineStore(VkPhysicalDevice physical, VkDevice device, const std::filesystem::path& folder);
  ~PipelineStore();
  PipelineStore(const PipelineStore&) = delete;
  PipelineStore& operator=(const PipelineStore&) = delete;

  VkPipelineCache handle() const { return cache_; }
  /// Returns the bytes that were read from the file, 0 if there were none that fit.
  std::size_t read_bytes() const { return read_.size(); }
  const std::filesystem::path& file() const { return file_; }

 private:
  void save() const;

  VkDevice device_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  std::filesystem::path file_;   // "": nothing is kept
  std::string key_;              // of device and driver
  std::vector<std::byte> read_;  // what the driver was given
};

}  // namespace nightcity::gpu
