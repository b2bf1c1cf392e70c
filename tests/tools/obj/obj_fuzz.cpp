// libFuzzer target: reads any bytes as Wavefront OBJ, and triangulates.
#include "tests/tools/city/fuzz_city.h"
#include "tools/obj/read_obj.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  test::fuzz_city(data, size, [](city::Document document, const auto& options, const auto& stage) {
    document.packed = true;  // no material library is looked for on this disk
    obj::read_obj_document(document, options, stage);
  });
  return 0;
}
