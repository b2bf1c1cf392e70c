// libFuzzer target: reads any text as the tags of a lamp, and as hours, dates, amounts and colours.
#include <cstdint>

#include "support/abort_with.h"
#include "tests/tools/lights/sound_tags.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  nightcity::test::abort_with(nightcity::test::find_fault_of_tags(text));
  return 0;
}
