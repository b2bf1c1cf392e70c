#include "tools/citygml/read_citygml.h"

#include <utility>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/text_encoding.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/libcitygml_reader.h"
#include "tools/citygml/stream_reader.h"

namespace nightcity::citygml {
namespace {

void tell_flat_buildings(const std::filesystem::path& file, city::ReadReport& report) {
  if (report.extruded > 0)
    report.warnings.push_back(file.string() + ": " + std::to_string(report.extruded) +
                              " buildings have a footprint alone (LoD0): made blocks of their "
                              "measured height");
  if (report.flat > 0)
    report.warnings.push_back(file.string() + ": " + std::to_string(report.flat) +
                              " buildings have a footprint alone (LoD0) and no measured height: "
                              "they are flat");
}

void make_texts_valid(city::ReadReport& report) {
  report.srs_name = city::to_valid_utf8(std::move(report.srs_name));
  for (std::string& warning : report.warnings) warning = city::to_valid_utf8(std::move(warning));
  std::map<std::string, std::size_t> skipped;
  for (const auto& [what, count] : report.skipped) skipped[city::to_valid_utf8(what)] += count;
  report.skipped = std::move(skipped);
}

}  // namespace

city::ReadReport read_citygml_staged(const std::filesystem::path& file,
                                     const city::ReadOptions& options,
                                     const city::ObjectStage& stage) {
  city::ReadReport report;
  for (const city::Document& document : list_citygml_documents(file, &report.warnings)) {
    if (options.reader == city::Reader::stream) {
      report.merge(read_with_stream(document, options, stage));
      continue;
    }
    report.merge(read_with_libcitygml(document, options, [&](city::CityObject&& object) {
      std::vector<city::CityObject> one;
      one.push_back(std::move(object));
      stage(std::move(one))();
    }));
  }
  tell_flat_buildings(file, report);
  make_texts_valid(report);
  return report;
}

city::ReadReport read_citygml(const std::filesystem::path& file, const city::ReadOptions& options,
                              const city::ObjectSink& sink) {
  return read_citygml_staged(file, options, city::deliver_to(sink));
}

}  // namespace nightcity::citygml
