// The renderer's shaders with a guard removed, to show that its test would fail. A copy of the
// shaders' text is edited and compiled, and passed to Vulkan in place of the built-in SPIR-V.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nightcity::test {

/// Replaces `guard`, which must occur exactly once in shaders/`file`, by `without`.
struct ShaderEdit {
  std::string file;
  std::string guard;
  std::string without;
};

/// As long as it lives, a new PassLibrary compiles the edited passes. Programs that use it link
/// with -Wl,--wrap=vkCreateShaderModule. Throws std::runtime_error when a guard is not found
/// exactly once, or an edited pass does not compile.
class MutatedShaders {
 public:
  explicit MutatedShaders(const std::vector<ShaderEdit>& edits);
  ~MutatedShaders();
  MutatedShaders(const MutatedShaders&) = delete;
  MutatedShaders& operator=(const MutatedShaders&) = delete;
};

}  // namespace nightcity::test
