// libFuzzer target: reads any bytes as a file of cameras, one pose or a path of many.
#include <cstdint>

#include "support/abort_with.h"
#include "support/fuzz_file.h"
#include "tests/runtime/scene/sound_camera.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity::test;
  const FuzzFile file(data, size);
  abort_with(find_fault_of_cameras(file.path(), {reinterpret_cast<const char*>(data), size}));
  return 0;
}
