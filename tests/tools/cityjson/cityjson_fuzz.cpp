// libFuzzer target: reads any bytes as CityJSON or CityJSONSeq, and triangulates.
#include "tests/tools/city/fuzz_city.h"
#include "tools/cityjson/read_cityjson.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  test::fuzz_city(data, size, [](const auto& document, const auto& options, const auto& stage) {
    cityjson::read_cityjson_document(document, false, options, stage);
  });
  return 0;
}
