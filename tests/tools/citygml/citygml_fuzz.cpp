// libFuzzer target: reads any bytes as a CityGML document with the stream reader, and triangulates.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "formats/error.h"
#include "tests/tools/citygml/memory_document.h"
#include "tools/citygml/stream_reader.h"
#include "tools/mesh/classify.h"
#include "tools/mesh/close_gaps.h"
#include "tools/mesh/triangulate.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  const std::string text(reinterpret_cast<const char*>(data), size);
  ReadOptions options;
  options.threads = 1;
  MeshReport report;
  try {
    const ObjectSink sink = [&](CityObject&& object) {
      repair_shells(object, report);
      classify_unknown_surfaces(object);
      for (const glm::dvec3& p : triangulate(object, report).positions)
        if (!std::isfinite(p.x + p.y + p.z)) std::abort();
    };
    read_with_stream(test::memory_document(text), options, deliver_to(sink));
  } catch (const Error&) {  // a broken document
  }
  return 0;
}
