#include "support/mutated_shaders.h"

#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <span>
#include <stdexcept>

#include "spirv/passes.h"
#include "support/temp_folder.h"

namespace nightcity::test {
namespace {

using Words = std::span<const std::uint32_t>;

struct Replacement {
  Words built_in;
  std::vector<std::uint32_t> edited;
};
std::vector<Replacement> replacements;

const std::map<std::string, Words>& built_in_passes() {
  static const std::map<std::string, Words> passes{
      {"accumulate", accumulate_spirv}, {"candidates", candidates_spirv},
      {"pair_reuse", pair_reuse_spirv}, {"pair_targets", pair_targets_spirv},
      {"primary", primary_spirv},       {"reference", reference_spirv},
      {"shade", shade_spirv},           {"spatial", spatial_spirv},
      {"temporal", temporal_spirv}};
  return passes;
}

// Is any of `files` the pass itself or among what it includes?
bool concerns(const std::filesystem::path& folder, const std::string& file,
              const std::set<std::string>& files) {
  if (files.count(file)) return true;
  const std::string text = read_text(folder / file);
  const std::string mark = "#include \"shaders/";
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    const std::size_t name = at + mark.size();
    if (concerns(folder, text.substr(name, text.find('"', name) - name), files)) return true;
  }
  return false;
}

}  // namespace

MutatedShaders::MutatedShaders(const std::vector<ShaderEdit>& edits) {
  namespace fs = std::filesystem;
  const TempFolder copy;
  const fs::path source = NIGHTCITY_SOURCE_DIR;
  for (const char* folder : {"shaders", "formats"}) {
    fs::create_directory(copy / folder);
    for (const auto& entry : fs::directory_iterator(source / folder))
      if (entry.is_regular_file())
        fs::copy_file(entry.path(), copy / folder / entry.path().filename());
  }
  const fs::path shaders = copy / "shaders";
  std::set<std::string> files;
  for (const ShaderEdit& edit : edits) {
    std::string text = read_text(shaders / edit.file);
    const std::size_t at = text.find(edit.guard);
    if (at == std::string::npos || text.find(edit.guard, at + 1) != std::string::npos)
      throw std::runtime_error("shaders/" + edit.file +
                               " does not hold exactly once: " + edit.guard);
    write_text(shaders / edit.file, text.replace(at, edit.guard.size(), edit.without));
    files.insert(edit.file);
  }
  replacements.clear();
  for (const auto& [pass, words] : built_in_passes()) {
    if (!concerns(shaders, pass + ".comp", files)) continue;
    const fs::path out = copy / (pass + ".spv");
    const std::string command = std::string("'") + NIGHTCITY_GLSLANG +
                                "' --quiet -V --target-env vulkan1.2 -I'" + copy.path().string() +
                                "' -o '" + out.string() + "' '" +
                                (shaders / (pass + ".comp")).string() + "' >&2";
    if (std::system(command.c_str()) != 0)
      throw std::runtime_error(pass + ".comp as edited does not compile");
    const std::string bytes = read_text(out);
    Replacement replacement{words, std::vector<std::uint32_t>(bytes.size() / 4)};
    std::memcpy(replacement.edited.data(), bytes.data(), 4 * replacement.edited.size());
    replacements.push_back(std::move(replacement));
  }
}

MutatedShaders::~MutatedShaders() {
  replacements.clear();
}

}  // namespace nightcity::test

extern "C" {

VkResult __real_vkCreateShaderModule(VkDevice, const VkShaderModuleCreateInfo*,
                                     const VkAllocationCallbacks*, VkShaderModule*);

VkResult __wrap_vkCreateShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                     const VkAllocationCallbacks* allocator,
                                     VkShaderModule* module) {
  VkShaderModuleCreateInfo edited = *info;
  for (const auto& [built_in, words] : nightcity::test::replacements)
    if (info->codeSize == built_in.size_bytes() &&
        std::memcmp(info->pCode, built_in.data(), info->codeSize) == 0) {
      edited.pCode = words.data();
      edited.codeSize = 4 * words.size();
    }
  return __real_vkCreateShaderModule(device, &edited, allocator, module);
}
}
