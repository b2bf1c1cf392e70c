#include "tools/citygml/stream_reader.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <unordered_set>
#include <utility>

#include "formats/error.h"
#include "tools/city/find_name.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/member_parser.h"
#include "tools/citygml/picture_colours.h"
#include "tools/citygml/read_citygml.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/server_answer.h"
#include "tools/citygml/shared_geometry.h"
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
  std::vector<std::size_t> deferred;  // members whose geometry stands elsewhere
  std::unordered_set<std::string> wanted;
};

class StreamReader {
 public:
  StreamReader(const city::Document& document, const city::ReadOptions& options,
               const city::ObjectStage& stage)
      : document_(document), options_(options), stage_(stage) {
    library_.folder = std::filesystem::path(document.name).parent_path();
    library_.file_name = std::filesystem::path(document.name).filename().string();
    library_.neighbours = options.neighbours;
    library_.max_vertices = static_cast<std::size_t>(options.max_linked_vertices);
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
      report_.needs_whole_file = "its members link to geometry of other members";
      return finish();
    }
    // Some members refer to geometry that others hold: fetch it, then read those members again.
    fetch_wanted();
    library_complete_ = true;
    const std::unordered_set<std::size_t> again(deferred_.begin(), deferred_.end());
    run(&again);
    return finish();
  }

 private:
  city::ReadReport&& finish() {
    if (!missing_.empty() && (!options_.piece || options_.piece->is_first()))
      report_.warnings.push_back(document_.name + ": " + missing_);
    if (pictures_)
      report_.warnings.push_back(
          document_.name + ": " + std::to_string(pictures_->pictures()) + " pictures (" +
          std::to_string(pictures_->pixels() / 1'000'000) + " megapixels) give " +
          std::to_string(pictures_->surfaces()) + " surfaces their mean colour" +
          (pictures_->keeps_pictures()
               ? "; on " + std::to_string(pictures_->laid_out()) + " polygons they are laid out"
               : ""));
    return std::move(report_);
  }

  void find_pictures() {
    const auto source = document_.open();
    const MemberSplitter splitter(*source, document_.name, limits_of(options_));
    pictures_.emplace(document_, splitter.head().latin1, options_.textures);
    library_.pictures = &*pictures_;
    file_materials_.set_pictures(library_.pictures);
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

  void fetch_wanted() {
    std::map<std::filesystem::path, std::unordered_set<std::string>> by_file;  // "" = this one
    for (const std::string& name : wanted_) {
      auto [file, id] = library_.split_name(name);
      by_file[std::move(file)].insert(std::move(id));
    }
    for (const auto& [file, ids] : by_file) {
      if (file.empty()) {
        take_geometry(document_, ids, {});
      } else if (read_citygml_head(file, options_).srs_name != own_srs_name()) {
        report_.warnings.push_back(document_.name + ": xlinks into " + file.string() +
                                   " are not followed: it is in another CRS");
      } else {
        for (const city::Document& neighbour : list_citygml_documents(file, nullptr))
          take_geometry(neighbour, ids, file.string() + "#");
      }
    }
  }

  void take_geometry(const city::Document& document, const std::unordered_set<std::string>& ids,
                     const std::string& prefix) {
    FetchedGeometry fetched =
        fetch_geometry(document, ids, options_, document_srs_name_, next_linked_, room_);
    for (auto& [id, polygons] : fetched.polygons)
      library_.polygons.emplace(prefix + id, std::move(polygons));
    if (fetched.beyond_room > 0)
      report_.warnings.push_back(
          document.name + ": " + std::to_string(fetched.beyond_room) +
          " links are not followed: what they lead to has more vertices than [city] "
          "max_linked_vertices = " +
          std::to_string(options_.max_linked_vertices) + " in a recipe allows");
  }

  // The name that read_citygml_head finds, to be compared with a neighbour's.
  std::string own_srs_name() const {
    if (document_.packed) return srs_name_;
    return read_citygml_head(document_.name, options_).srs_name;
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
      pugi::xml_document xml;
      const bool names_any = options_.srs_name && mentions_srs_name(batch.text(member));
      load(head, batch, member, xml);
      MemberParser parser(xml.document_element(), member.line, library_, file_materials_);
      if (names_any) {
        scope.enter(xml);
        parser.set_srs_scope(&scope);
        parser.set_srs_name(scope.name_of_rest());
      } else {
        parser.set_srs_name(scope.name_of_document());
      }
      std::vector<city::RawObject> raws = parser.parse();
      if (!parser.unresolved().empty() && !library_complete_) {
        out.deferred.push_back(number);
        out.wanted.insert(parser.unresolved().begin(), parser.unresolved().end());
        continue;
      }
      for (const std::string& id : parser.unresolved())
        out.report.warnings.push_back(document_.name + ":" + std::to_string(member.line) +
                                      ": xlink to " + id + ", which is not there");
      parser.skipped().merge_into(out.report.skipped);
      for (city::RawObject& raw : raws) {
        raw.object.continues = member.continued;
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
  GeometryLibrary library_;
  bool library_complete_ = false;
  std::uint64_t next_linked_ = 1;
  std::size_t room_ = static_cast<std::size_t>(options_.max_linked_vertices);
  std::vector<std::size_t> deferred_;
  std::unordered_set<std::string> wanted_;
};

}  // namespace

city::ReadReport read_with_stream(const city::Document& document, const city::ReadOptions& options,
                                  const city::ObjectStage& stage) {
  return StreamReader(document, options, stage).read();
}

}  // namespace nightcity::citygml
