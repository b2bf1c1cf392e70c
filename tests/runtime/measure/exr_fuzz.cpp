// libFuzzer target: reads any bytes as an OpenEXR picture.
#include <cstdint>

#include "support/abort_with.h"
#include "support/fuzz_file.h"
#include "tests/runtime/measure/sound_exr.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity::test;
  const FuzzFile file(data, size);
  abort_with(find_fault_of_exr(file.path()));
  return 0;
}
