// libFuzzer target: any bytes as a CityGML document, through the stream reader and the triangulation.
//   cmake -DCMAKE_CXX_COMPILER=clang++ -DNIGHTCITY_FUZZ=ON ... && citygml_fuzz tests/tools/citygml/corpus
// What it finds goes into the corpus, which corpus_test.cpp reads in every test run.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "formats/error.h"
#include "tests/tools/citygml/memory_document.h"
#include "tools/citygml/document_reader.h"
#include "tools/mesh/triangle_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  const std::string text(reinterpret_cast<const char*>(data), size);
  ReadOptions options;
  options.threads = 1;
  MeshReport report;
  try {
    read_with_stream(test::memory_document(text), options, [&](CityObject&& object) {
      orient_outward(object, report);
      classify_unknown_surfaces(object);
      for (const glm::dvec3& p : triangulate(object, report).positions)
        if (!std::isfinite(p.x + p.y + p.z)) std::abort();
    });
  } catch (const Error&) {  // what a broken document deserves
  }
  return 0;
}
