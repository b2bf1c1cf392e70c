// libFuzzer target: reads any bytes as a measured luminaire, IES LM-63, EULUMDAT, TM-33 or GLDF.
#include <cstdint>

#include "support/abort_with.h"
#include "support/fuzz_file.h"
#include "tests/tools/lights/sound_luminaire.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity::test;
  const FuzzFile file(data, size);
  abort_with(find_fault_of_luminaire(file.path()));
  return 0;
}
