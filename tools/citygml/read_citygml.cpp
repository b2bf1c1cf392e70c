#include <memory>
#include <utility>

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

ObjectStage deliver_to(const ObjectSink& sink) {
  return [&sink](std::vector<CityObject>&& objects) -> std::function<void()> {
    // std::function wants to copy what it holds.
    const auto held = std::make_shared<std::vector<CityObject>>(std::move(objects));
    return [&sink, held] {
      for (CityObject& object : *held) sink(std::move(object));
    };
  };
}

ReadReport read_citygml_staged(const std::filesystem::path& file, const ReadOptions& options,
                               const ObjectStage& stage) {
  ReadReport report;
  for (const Document& document : documents_in(file)) {
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
