#include "tools/citygml/stream_reader.h"

#include <algorithm>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <unordered_set>
#include <utility>

#include "formats/error.h"
#include "tools/city/find_name.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/link_targets.h"
#include "tools/citygml/member_parser.h"
#include "tools/citygml/picture_colours.h"
#include "tools/citygml/read_citygml.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/server_answer.h"
#include "tools/citygml/srs_scope.h"
#include "tools/in_order.h"

namespace nightcity::citygml {
namespace {

constexpr std::size_t max_warnings = 50;

bool is_object_member(const MemberBatch::Member& member) {
  return member.name == "cityObjectMember" || member.name == "featureMember" ||
         member.name == "member" || find_feature_class(member.name).kind != ClassKind::unknown;
}

bool mentions_srs_name(std::string_view text) {
  return city::find_name(text, "srsName") != std::string_view::npos;
}

bool mentions_link(std::string_view text) {
  return city::find_name(text, "href") != std::string_view::npos;
}

MemberBatch copy_member(const MemberBatch& whole, std::size_t number) {
  MemberBatch one;
  one.first_member = whole.first_member + number;
  const std::string_view text = whole.text(whole.members[number]);
  one.bytes = std::make_unique_for_overwrite<char[]>(text.size());
  text.copy(one.bytes.get(), text.size());
  one.members.push_back(whole.members[number]);
  one.members.front().begin = 0;
  return one;
}

struct BatchResult {
  std::vector<city::CityObject> objects;
  std::function<void()> rest;  // what the stage leaves to be done in file order
  city::ReadReport report;
  /// Members that cannot be read yet: they link to what stands elsewhere, or others may link to
  /// them.
  std::vector<std::size_t> deferred;
  std::unordered_set<std::string> wanted;  // geometry
  std::vector<FeatureLinks> links;
};

class StreamReader {
 public:
  StreamReader(const city::Document& document, std::span<const city::Document> siblings,
               const city::ReadOptions& options, const city::ObjectStage& stage)
      : document_(document),
        options_(options),
        stage_(stage),
        targets_(document, siblings, options) {
    if (options.textures == city::Textures::none || document.packed) return;
    reads_textures_ = true;
  }

  city::ReadReport read() {
    if (reads_textures_) find_pictures();
    if (!options_.piece) read_file_materials();  // a file that has them is not cut
    run(nullptr);
    report_.srs_name = srs_name_;
    if (deferred_.empty()) return finish();
    if (options_.piece) {
      report_.needs_whole_file = "its members link to geometry or objects of other members";
      return finish();
    }
    // Some members refer to what others hold: fetch it, then read those members again.
    targets_.fetch(wanted_, document_srs_name_, report_.warnings);
    targets_complete_ = true;
    const std::unordered_set<std::size_t> again(deferred_.begin(), deferred_.end());
    run(&again);
    return finish();
  }

 private:
  city::ReadReport&& finish() {
    if (!missing_.empty() && (!options_.piece || options_.piece->is_first()))
      report_.warnings.push_back(document_.name + ": " + missing_);
    if (pictures_) {
      report_.coloured_by_pictures = pictures_->surfaces();
      report_.laid_out_pictures = pictures_->laid_out();
    }
    return std::move(report_);
  }

  void find_pictures() {
    const auto source = document_.open();
    const MemberSplitter splitter(*source, document_.name, limits_of(options_));
    pictures_.emplace(document_, splitter.head().latin1, options_.textures);
    targets_.library().pictures = &*pictures_;
    file_materials_.set_pictures(targets_.library().pictures);
  }

  // The document's own appearances may stand behind the objects they colour, so they are read
  // first. A document without any costs a look for the word.
  void read_file_materials() {
    constexpr std::string_view element = "appearanceMember";
    const auto source = document_.open();
    MemberSplitter splitter(*source, document_.name, limits_of(options_));
    require_citygml(splitter.head(), document_.name);
    if (!city::mentions(document_, element)) return;
    MemberBatch batch;
    city::SkipCounter textures;
    while (splitter.next(batch))
      for (const MemberBatch::Member& member : batch.members) {
        if (member.name != element) continue;
        pugi::xml_document xml;
        load(splitter.head(), batch, member, xml);
        file_materials_.read(xml.document_element(), textures);
      }
    textures.merge_into(report_.skipped);
  }

  void load(const DocumentHead& head, const MemberBatch& batch, const MemberBatch::Member& member,
            pugi::xml_document& xml) const {
    const pugi::xml_parse_result result =
        xml.load_buffer_inplace(batch.bytes.get() + member.begin, member.size, gml_parse_flags,
                                head.latin1 ? pugi::encoding_latin1 : pugi::encoding_utf8);
    if (!result)
      throw Error(document_.name, member.line,
                  "not XML: " + std::string(result.description()) + " in <" + member.name + ">");
  }

  // Parses a batch; `only` = members to read (null: all).
  BatchResult parse(const DocumentHead& head, const MemberBatch& batch,
                    const std::unordered_set<std::size_t>* only) const {
    BatchResult out;
    SrsScope scope(options_.srs_name, document_srs_name_);
    for (std::size_t i = 0; i < batch.members.size(); ++i) {
      const MemberBatch::Member& member = batch.members[i];
      const std::size_t number = batch.first_member + i;
      if (only && !only->contains(number)) continue;
      if (options_.piece && !options_.piece->is_first() && number < options_.piece->head_members)
        continue;  // of the file's head: the first piece has it
      if (!is_object_member(member)) {
        if (member.name != "boundedBy" && member.name != "appearanceMember")
          ++out.report.skipped[member.name];
        if (is_server_error(member.name))
          out.report.warnings.push_back(document_.name + ":" + std::to_string(member.line) +
                                        ": incomplete: the server broke its answer off here (<" +
                                        member.name + ">): ask for a smaller area");
        continue;
      }
      if (targets_.features().is_given_away(number)) continue;
      pugi::xml_document xml;
      bool names_any = options_.srs_name && mentions_srs_name(batch.text(member));
      const bool has_links = mentions_link(batch.text(member));
      load(head, batch, member, xml);
      FeatureLinks links;
      std::vector<std::string> joined;
      if (targets_complete_) {
        joined = targets_.features().put_into(xml, number, targets_.library());
        names_any = options_.srs_name.has_value();
      } else {
        links = take_feature_links(xml, has_links, targets_.library());
      }
      MemberParser parser(xml.document_element(), member.line, targets_.library(), file_materials_);
      if (names_any) {
        scope.enter(xml);
        parser.set_srs_scope(&scope);
        parser.set_srs_name(scope.name_of_rest());
      } else {
        parser.set_srs_name(scope.name_of_document());
      }
      std::vector<city::RawObject> raws = parser.parse();
      if (!targets_complete_ && (!parser.unresolved().empty() || !links.empty())) {
        out.deferred.push_back(number);
        links.member = number;
        if (!links.empty()) out.links.push_back(std::move(links));
        out.wanted.insert(parser.unresolved().begin(), parser.unresolved().end());
        continue;
      }
      for (const std::string& id : parser.unresolved())
        out.report.warnings.push_back(document_.name + ":" + std::to_string(member.line) +
                                      ": xlink to " + id + ", which is not there");
      parser.skipped().merge_into(out.report.skipped);
      for (city::RawObject& raw : raws) {
        raw.object.continues = member.continued;
        raw.object.joined_ids = joined;
        out.objects.push_back(city::merge_parts(std::move(raw), options_, out.report));
      }
    }
    if (!out.objects.empty()) out.rest = stage_(std::exchange(out.objects, {}));
    return out;
  }

  void take(BatchResult&& result) {
    if (result.rest) result.rest();
    result.report.version.clear();
    const std::size_t room = max_warnings - std::min(max_warnings, report_.warnings.size());
    if (result.report.warnings.size() > room) result.report.warnings.resize(room);
    report_.merge(result.report);
    deferred_.insert(deferred_.end(), result.deferred.begin(), result.deferred.end());
    wanted_.merge(result.wanted);
    for (FeatureLinks& links : result.links) targets_.features().note(std::move(links));
  }

  bool next(MemberSplitter& splitter, MemberBatch& batch) {
    if (!splitter.next(batch)) return false;
    // Before parsing, which changes the text.
    if (srs_name_.empty()) srs_name_ = first_srs_name(batch);
    if (batch.first_member == 0) document_srs_name_ = document_srs_name(batch);
    return true;
  }

  void run(const std::unordered_set<std::size_t>* only) {
    const auto source = document_.open();
    MemberSplitter splitter(*source, document_.name, limits_of(options_));
    report_.version = splitter.head().version;
    missing_ = find_what_is_missing(splitter.head());
    const DocumentHead& head = splitter.head();
    MemberBatch whole;
    std::size_t at = 0;  // the next of its members, where they are passed on one by one
    in_order(
        options_.threads,
        [&]() -> std::optional<MemberBatch> {
          if (at == whole.members.size()) {
            at = 0;
            if (!next(splitter, whole)) return {};
          }
          if (options_.passes_one_by_one()) return copy_member(whole, at++);
          return std::exchange(whole, {});
        },
        [&](MemberBatch&& batch) { return parse(head, batch, only); },
        [&](BatchResult&& result) { take(std::move(result)); });
  }

  const city::Document& document_;
  const city::ReadOptions& options_;
  const city::ObjectStage& stage_;
  city::ReadReport report_;
  std::string srs_name_, document_srs_name_, missing_;
  bool reads_textures_ = false;
  std::optional<PictureColours> pictures_;
  Materials file_materials_;
  LinkTargets targets_;
  bool targets_complete_ = false;
  std::vector<std::size_t> deferred_;
  std::unordered_set<std::string> wanted_;
};

}  // namespace

city::ReadReport read_with_stream(const city::Document& document,
                                  std::span<const city::Document> siblings,
                                  const city::ReadOptions& options,
                                  const city::ObjectStage& stage) {
  return StreamReader(document, siblings, options, stage).read();
}

}  // namespace nightcity::citygml
