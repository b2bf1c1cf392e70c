// libFuzzer target: reads any bytes as CityJSON or CityJSONSeq, and triangulates.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "formats/error.h"
#include "tests/tools/citygml/memory_document.h"
#include "tools/cityjson/read_cityjson.h"
#include "tools/mesh/classify.h"
#include "tools/mesh/close_gaps.h"
#include "tools/mesh/triangulate.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  const std::string text(reinterpret_cast<const char*>(data), size);
  city::ReadOptions options;
  options.threads = 1;
  mesh::MeshReport report;
  try {
    const city::ObjectSink sink = [&](city::CityObject&& object) {
      mesh::repair_shells(object, report);
      mesh::classify_unknown_surfaces(object);
      for (const glm::dvec3& p : mesh::triangulate(object, report).positions)
        if (!std::isfinite(p.x + p.y + p.z)) std::abort();
    };
    cityjson::read_cityjson_document(test::memory_document(text), false, options,
                                     city::deliver_to(sink));
  } catch (const Error&) {  // a broken document
  }
  return 0;
}
