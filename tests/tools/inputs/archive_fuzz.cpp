// libFuzzer target: reads any bytes as a file of documents: plain, gzipped, or an archive.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "formats/error.h"
#include "support/fuzz_file.h"
#include "tests/tools/inputs/mutate_archive.h"
#include "tools/city/byte_source.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  const test::FuzzFile file(data, size);
  constexpr std::array<std::string_view, 3> endings{".gml", ".xml", ".json"};
  try {
    for (const city::Document& document : city::list_documents(file.path(), endings)) {
      const std::string start = city::read_start(document, 100);
      if (start.size() > 100) std::abort();
      std::array<char, 4096> piece;
      std::string whole;
      const auto source = document.open();
      while (const std::size_t count = source->read(piece.data(), piece.size())) {
        if (count > piece.size()) std::abort();
        if (whole.size() < 100) whole.append(piece.data(), count);
      }
      // A second reading gives the same.
      if (whole.substr(0, start.size()) != start) std::abort();
    }
  } catch (const Error&) {  // a broken file
  }
  return 0;
}
