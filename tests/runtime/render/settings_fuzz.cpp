// libFuzzer target: reads any bytes as a settings file.
#include <cstdint>

#include "support/abort_with.h"
#include "support/fuzz_file.h"
#include "tests/runtime/render/sound_settings.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity::test;
  const FuzzFile file(data, size);
  abort_with(find_fault_of_settings(file.path()));
  return 0;
}
