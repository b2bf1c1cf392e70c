// libFuzzer target: reads any bytes as a CityGML document with the stream reader, and triangulates.
#include "tests/tools/city/fuzz_city.h"
#include "tools/citygml/stream_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  test::fuzz_city(data, size, [](const auto& document, const auto& options, const auto& stage) {
    citygml::read_with_stream(document, {}, options, stage);
  });
  return 0;
}
