#include "tools/citygml/read_citygml.h"

#include <utility>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/libcitygml_reader.h"
#include "tools/citygml/link_targets.h"
#include "tools/citygml/stream_reader.h"

namespace nightcity::citygml {
city::ReadReport read_citygml_staged(const std::filesystem::path& file,
                                     const city::ReadOptions& options,
                                     const city::ObjectStage& stage) {
  city::ReadReport report;
  if (options.piece) {
    const city::Document piece{file.string(), false,
                               [&] { return city::open_piece(file, *options.piece); }};
    return read_with_stream(piece, {}, options, stage);
  }
  const std::vector<city::Document> documents = list_citygml_documents(file, &report.warnings);
  city::ReadOptions with_siblings = options;
  with_siblings.neighbours = add_siblings(options.neighbours, documents);
  for (const city::Document& document : documents) {
    if (options.reader == city::Reader::stream) {
      report.merge(read_with_stream(document, documents, with_siblings, stage));
      continue;
    }
    report.merge(read_with_libcitygml(document, options, [&](city::CityObject&& object) {
      std::vector<city::CityObject> one;
      one.push_back(std::move(object));
      stage(std::move(one))();
    }));
  }
  city::finish_report(file, report);
  return report;
}

city::ReadReport read_citygml(const std::filesystem::path& file, const city::ReadOptions& options,
                              const city::ObjectSink& sink) {
  return read_citygml_staged(file, options, city::deliver_to(sink));
}

}  // namespace nightcity::citygml
