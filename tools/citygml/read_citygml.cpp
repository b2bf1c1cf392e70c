#include "formats/error.h"
#include "tools/citygml/byte_source.h"
#include "tools/citygml/city_model.h"
#include "tools/citygml/document_reader.h"

namespace nightcity {

void require_citygml(const DocumentHead& head, const std::string& name) {
  const std::string_view root = local_name(head.root_name);
  if (root != "CityModel" && root != "FeatureCollection")
    throw Error(name, "is not CityGML: its root element is <" + head.root_name + ">");
}

std::string first_srs_name(const MemberBatch& batch) {
  constexpr std::string_view key = "srsName=";
  for (const MemberBatch::Member& member : batch.members) {
    const std::string_view text = batch.text(member);
    const auto at = text.find(key);
    if (at == std::string_view::npos || at + key.size() >= text.size()) continue;
    const auto begin = at + key.size() + 1;
    const auto end = text.find(text[begin - 1], begin);
    if (end != std::string_view::npos) return std::string(text.substr(begin, end - begin));
  }
  return {};
}

ReadReport read_citygml(const std::filesystem::path& file, const ReadOptions& options,
                        const ObjectSink& sink) {
  ReadReport report;
  for (const Document& document : documents_in(file))
    report.merge(options.reader == Reader::libcitygml ? read_with_libcitygml(document, options, sink)
                                                      : read_with_stream(document, options, sink));
  return report;
}

}  // namespace nightcity
