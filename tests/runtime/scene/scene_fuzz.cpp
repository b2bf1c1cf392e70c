// libFuzzer target: loads any bytes as a scene with its hierarchies, as nightview does.
#include <cstdint>

#include "support/abort_with.h"
#include "support/fuzz_file.h"
#include "tests/runtime/scene/sound_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity::test;
  const FuzzFile file(data, size);
  abort_with(find_fault_of_scene(file.path()));
  return 0;
}
