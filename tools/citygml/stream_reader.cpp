// The stream reader: members parsed in place, several batches at a time, delivered in file order.
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <pugixml.hpp>
#include <unordered_set>
#include <utility>

#include "formats/error.h"
#include "tools/citygml/document_reader.h"
#include "tools/citygml/member_parser.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/shared_geometry.h"

namespace nightcity {
namespace {

constexpr std::size_t most_warnings = 50;

bool is_object_member(const MemberBatch::Member& member) {
  return member.name == "cityObjectMember" || member.name == "featureMember" || member.name == "member" ||
         feature_class(member.name).kind != ClassKind::unknown;
}

struct BatchResult {
  std::vector<CityObject> objects;
  std::function<void()> rest;  // what the stage leaves to be done in file order
  ReadReport report;
  std::vector<std::size_t> deferred;  // members whose geometry stands elsewhere
  std::unordered_set<std::string> wanted;
};

class StreamReader {
 public:
  StreamReader(const Document& document, const ReadOptions& options, const ObjectStage& stage)
      : document_(document), options_(options), stage_(stage) {}

  ReadReport read() {
    read_file_materials();
    run(nullptr);
    report_.srs_name = srs_name_;
    if (deferred_.empty()) return std::move(report_);
    // Some members refer to geometry that others hold: fetch it, then read those members again.
    library_ = fetch_geometry(document_, wanted_);
    library_complete_ = true;
    const std::unordered_set<std::size_t> again(deferred_.begin(), deferred_.end());
    run(&again);
    return std::move(report_);
  }

 private:
  // The document's own appearances stand before or behind all objects; where they are is seen at both ends of
  // the file. Without any, this costs two looks.
  void read_file_materials() {
    constexpr std::string_view element = "appearanceMember";
    constexpr std::size_t end_bytes = std::size_t{1} << 18;
    const auto source = document_.open();
    MemberSplitter splitter(*source, document_.name, {});
    require_citygml(splitter.head(), document_.name);
    const bool at_end = document_.tail(end_bytes).find(element) != std::string::npos;
    MemberBatch batch;
    SkipCounter textures;
    bool any = at_end;
    for (bool first = true; splitter.next(batch) && (first || any); first = false) {
      for (const MemberBatch::Member& member : batch.members) {
        if (member.name != element) continue;
        any = true;
        pugi::xml_document xml;
        load(splitter.head(), batch, member, xml);
        file_materials_.read(xml.document_element(), textures);
      }
    }
    materials_read_ = any;
    textures.merge_into(report_.skipped);
  }

  void load(const DocumentHead& head, const MemberBatch& batch, const MemberBatch::Member& member,
            pugi::xml_document& xml) const {
    const pugi::xml_parse_result result =
        xml.load_buffer_inplace(batch.bytes.get() + member.begin, member.size, gml_parse_flags,
                                head.latin1 ? pugi::encoding_latin1 : pugi::encoding_utf8);
    if (!result)
      throw Error(document_.name, "line " + std::to_string(member.line),
                  "not XML: " + std::string(result.description()) + " in <" + member.name + ">");
  }

  // Parses a batch; `only` = members to read (null: all).
  BatchResult parse(const DocumentHead& head, const MemberBatch& batch,
                    const std::unordered_set<std::size_t>* only) const {
    BatchResult out;
    for (std::size_t i = 0; i < batch.members.size(); ++i) {
      const MemberBatch::Member& member = batch.members[i];
      const std::size_t number = batch.first_member + i;
      if (only && !only->contains(number)) continue;
      if (!is_object_member(member)) {
        if (member.name != "boundedBy" && !(materials_read_ && member.name == "appearanceMember"))
          ++out.report.skipped[member.name];
        continue;
      }
      pugi::xml_document xml;
      load(head, batch, member, xml);
      MemberParser parser(xml.document_element(), member.line, library_, file_materials_);
      std::vector<RawObject> raws = parser.parse();
      if (!parser.unresolved().empty() && !library_complete_) {
        out.deferred.push_back(number);
        out.wanted.insert(parser.unresolved().begin(), parser.unresolved().end());
        continue;
      }
      for (const std::string& id : parser.unresolved())
        out.report.warnings.push_back(document_.name + ": line " + std::to_string(member.line) +
                                      ": xlink to #" + id + ", which the file does not hold");
      parser.skipped().merge_into(out.report.skipped);
      for (RawObject& raw : raws) {
        raw.continued = member.continued;
        out.objects.push_back(fold(std::move(raw), options_, out.report));
      }
    }
    if (!out.objects.empty()) out.rest = stage_(std::exchange(out.objects, {}));
    return out;
  }

  void take(BatchResult&& result) {
    if (result.rest) result.rest();
    result.report.version.clear();
    const std::size_t room = most_warnings - std::min(most_warnings, report_.warnings.size());
    if (result.report.warnings.size() > room) result.report.warnings.resize(room);
    report_.merge(result.report);
    deferred_.insert(deferred_.end(), result.deferred.begin(), result.deferred.end());
    wanted_.merge(result.wanted);
  }

  bool next(MemberSplitter& splitter, MemberBatch& batch) {
    if (!splitter.next(batch)) return false;
    if (srs_name_.empty()) srs_name_ = first_srs_name(batch);  // before parsing, which changes the text
    return true;
  }

  void run(const std::unordered_set<std::size_t>* only) {
    const auto source = document_.open();
    MemberSplitter splitter(*source, document_.name, {});
    report_.version = splitter.head().version;
    const DocumentHead& head = splitter.head();
    const int cores = oneapi::tbb::this_task_arena::max_concurrency();
    const int threads = options_.threads > 0 ? std::min(static_cast<int>(options_.threads), cores) : cores;
    if (threads == 1) {
      MemberBatch batch;
      while (next(splitter, batch)) take(parse(head, batch, only));
      return;
    }
    using BatchPtr = std::shared_ptr<MemberBatch>;
    using ResultPtr = std::shared_ptr<BatchResult>;
    namespace tbb = oneapi::tbb;
    const auto split = [&](tbb::flow_control& flow) -> BatchPtr {
      auto batch = std::make_shared<MemberBatch>();
      if (!next(splitter, *batch)) flow.stop();
      return batch;
    };
    const auto parse_one = [&](const BatchPtr& batch) {
      return std::make_shared<BatchResult>(parse(head, *batch, only));
    };
    const auto deliver = [&](const ResultPtr& result) { take(std::move(*result)); };
    tbb::task_arena arena(threads);
    arena.execute([&] {
      tbb::parallel_pipeline(
          static_cast<std::size_t>(2 * threads),
          tbb::make_filter<void, BatchPtr>(tbb::filter_mode::serial_in_order, split) &
              tbb::make_filter<BatchPtr, ResultPtr>(tbb::filter_mode::parallel, parse_one) &
              tbb::make_filter<ResultPtr, void>(tbb::filter_mode::serial_in_order, deliver));
    });
  }

  const Document& document_;
  const ReadOptions& options_;
  const ObjectStage& stage_;
  ReadReport report_;
  std::string srs_name_;
  Materials file_materials_;
  bool materials_read_ = false;
  GeometryLibrary library_;
  bool library_complete_ = false;
  std::vector<std::size_t> deferred_;
  std::unordered_set<std::string> wanted_;
};

}  // namespace

ReadReport read_with_stream(const Document& document, const ReadOptions& options, const ObjectStage& stage) {
  return StreamReader(document, options, stage).read();
}

}  // namespace nightcity
