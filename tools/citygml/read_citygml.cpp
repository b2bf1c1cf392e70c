#include "tools/citygml/read_citygml.h"

#include <utility>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/citygml/libcitygml_reader.h"
#include "tools/citygml/stream_reader.h"

namespace nightcity {

ReadReport read_citygml_staged(const std::filesystem::path& file, const ReadOptions& options,
                               const ObjectStage& stage) {
  ReadReport report;
  for (const city::Document& document : city::list_documents(file, citygml_endings)) {
    if (options.reader == Reader::stream) {
      report.merge(read_with_stream(document, options, stage));
      continue;
    }
    report.merge(read_with_libcitygml(document, options, [&](CityObject&& object) {
      std::vector<CityObject> one;
      one.push_back(std::move(object));
      stage(std::move(one))();
    }));
  }
  return report;
}

ReadReport read_citygml(const std::filesystem::path& file, const ReadOptions& options,
                        const ObjectSink& sink) {
  return read_citygml_staged(file, options, deliver_to(sink));
}

}  // namespace nightcity
