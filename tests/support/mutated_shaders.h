// The renderer's shaders with a line taken out: shows that a test would notice. The shaders themselves know
// nothing of it: their text is edited in a copy, compiled, and handed to Vulkan in place of the built-in
// words.
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

/// While it lives, passes compiled from a new PassLibrary are the edited ones. Programs that use it are
/// linked with -Wl,--wrap=vkCreateShaderModule. Throws std::runtime_error where a guard is not found or the
/// edit does not compile.
class MutatedShaders {
 public:
  explicit MutatedShaders(const std::vector<ShaderEdit>& edits);
  ~MutatedShaders();
  MutatedShaders(const MutatedShaders&) = delete;
  MutatedShaders& operator=(const MutatedShaders&) = delete;
};

}  // namespace nightcity::test
