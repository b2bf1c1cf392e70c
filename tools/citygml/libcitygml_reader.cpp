// Protects libcitygml 2.4.3 from what makes it fail: it gets a batch of members at a time, single
// members where a batch fails, and never sees comments, entities or a DOCTYPE. What it leaves out
// is counted.
#include "tools/citygml/libcitygml_reader.h"

#include <citygml/address.h>
#include <citygml/citygml.h>
#include <citygml/citygmllogger.h>
#include <citygml/citymodel.h>

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>

#include "formats/error.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/libcitygml_convert.h"
#include "tools/citygml/libcitygml_text.h"

namespace nightcity::citygml {
namespace {

constexpr std::size_t batch_bytes = std::size_t{1} << 19;  // about 100 members: full speed in 44 MB
constexpr std::size_t max_library_warnings = 20;

class Logger final : public ::citygml::CityGMLLogger {
 public:
  Logger() : CityGMLLogger(LOGLEVEL::LL_WARNING) {}
  void log(LOGLEVEL, const std::string& message, const char*, int) const override {
    messages.push_back(message);
  }
  mutable std::vector<std::string> messages;
};

::citygml::ParserParams parameters() {
  ::citygml::ParserParams p;
  p.tesselate = false;    // rings, not GLU's triangles
  p.keepVertices = true;  // rings survive the end of parsing
  return p;
}

// libcitygml, Xerces and GDAL initialise themselves on first use without a lock, so this happens
// before there is a second thread.
void warm_up() {
  static std::once_flag once;
  std::call_once(once, [] {
    std::istringstream text("<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\"/>");
    try {
      (void)::citygml::load(text, parameters(), std::make_shared<Logger>());
    } catch (...) {  // what fails here fails again when a file is read, and is reported there
    }
  });
}

std::size_t count_polygons(std::string_view text) {
  std::size_t count = 0;
  for (auto at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    std::size_t end = at + 1;
    while (end < text.size() && !ends_name(text[end])) ++end;
    const std::string_view name = local_name(text.substr(at + 1, end - at - 1));
    count +=
        name == "Polygon" || name == "Triangle" || name == "Rectangle" || name == "PolygonPatch";
  }
  return count;
}

// Returns the class of the object in a member: "<cityObjectMember><urf:UseDistrict ...".
std::string class_in(std::string_view member) {
  auto at = member.find('<', 1);
  while (at != std::string_view::npos && at + 1 < member.size() &&
         (member[at + 1] == '!' || member[at + 1] == '?'))
    at = member.find('<', at + 1);
  if (at == std::string_view::npos) return "nothing";
  std::size_t end = at + 1;
  while (end < member.size() && !ends_name(member[end])) ++end;
  return std::string(member.substr(at + 1, end - at - 1));
}

class DocumentLoader {
 public:
  DocumentLoader(const DocumentHead& head, const std::string& name,
                 const city::ReadOptions& options, const city::ObjectSink& sink)
      : head_(head), name_(name), options_(options), sink_(sink) {
    report.version = head.version;
  }

  void load_batch(const MemberBatch& batch) {
    std::string text = opening();
    std::vector<const MemberBatch::Member*> members;
    for (const MemberBatch::Member& member : batch.members) {
      if (!is_object_member(member)) continue;
      if (const std::string other = find_other_srs_name(batch.text(member)); !other.empty())
        skip(batch, member,
             "names another CRS (" + other +
                 ") than the file's first geometry: [city] reader = "
                 "\"stream\" places it");
      else if (append_guarded(batch.text(member), text))
        members.push_back(&member);
      else
        skip(batch, member, "a text over 1,000,000 characters");
    }
    if (members.empty()) return;
    std::size_t polygons = 0;
    for (const MemberBatch::Member* member : members)
      polygons += count_polygons(batch.text(*member));
    std::string why;
    if (load_text(text, polygons, why)) return;
    for (const MemberBatch::Member* member : members) {
      text = opening();
      append_guarded(batch.text(*member), text);
      if (!load_text(text, count_polygons(batch.text(*member)), why)) skip(batch, *member, why);
    }
  }

  city::ReadReport report;

 private:
  std::string opening() const {
    return (head_.latin1 ? "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>" : "") + head_.root_tag;
  }

  bool is_object_member(const MemberBatch::Member& member) {
    if (member.name == "cityObjectMember" || member.name == "featureMember" ||
        member.name == "appearanceMember")
      return true;
    if (member.name != "boundedBy") ++report.skipped[member.name];
    return false;
  }

  // libcitygml does not tell which CRS a geometry has.
  std::string find_other_srs_name(std::string_view text) const {
    if (!options_.srs_name) return {};
    for (const std::string& name : list_srs_names(text))
      if (name != *options_.srs_name) return name;
    return {};
  }

  void skip(const MemberBatch& batch, const MemberBatch::Member& member, const std::string& why) {
    const std::string object = class_in(batch.text(member));
    ++report.skipped[object];
    if (const std::size_t polygons = count_polygons(batch.text(member)); polygons > 0)
      report.skipped["polygon: in a member libcitygml cannot read"] += polygons;
    warn(name_ + ":" + std::to_string(member.line) + ": " + object + ": " + why);
  }

  void warn(const std::string& message) {
    if (report.warnings.size() < max_library_warnings) report.warnings.push_back(message);
  }

  // Returns false, with the reason, when libcitygml throws; then nothing has been delivered.
  bool load_text(const std::string& members, std::size_t polygons_in_text, std::string& why) {
    std::istringstream stream(members + "</" + head_.root_name + ">");
    const auto logger = std::make_shared<Logger>();
    std::shared_ptr<const ::citygml::CityModel> model;
    try {
      model = ::citygml::load(stream, parameters(), logger);
    } catch (const std::exception& e) {
      why = e.what();
      return false;
    } catch (...) {  // Xerces' exceptions have no base class
      why = "libcitygml's XML parser refuses it";
      return false;
    }
    if (!model) {
      why = "libcitygml makes nothing of it";
      return false;
    }
    if (report.srs_name.empty()) report.srs_name = model->getSRSName();
    if (!logger->messages.empty()) report.skipped["libcitygml warning"] += logger->messages.size();
    for (const std::string& message : logger->messages) warn(name_ + ": libcitygml: " + message);
    std::size_t seen = 0;
    for (const ::citygml::CityObject* root : model->getRootCityObjects()) {
      LibcitygmlObject converted = convert(*root, model->themes());
      seen += converted.polygons_seen;
      for (const auto& [what, count] : converted.skipped) report.skipped[what] += count;
      sink_(city::merge_parts(std::move(converted.raw), options_, report));
    }
    if (polygons_in_text > seen)
      report.skipped["polygon: not delivered by libcitygml"] += polygons_in_text - seen;
    return true;
  }

  const DocumentHead& head_;
  const std::string& name_;
  const city::ReadOptions& options_;
  const city::ObjectSink& sink_;
};

}  // namespace

city::ReadReport read_with_libcitygml(const city::Document& document,
                                      const city::ReadOptions& options,
                                      const city::ObjectSink& sink) {
  warm_up();
  MemberSplitter::Limits limits = limits_of(options);
  limits.batch_bytes = batch_bytes;
  limits.every_tag = true;  // libcitygml gets well-formed XML only
  const auto source = document.open();
  MemberSplitter splitter(*source, document.name, limits);
  require_citygml(splitter.head(), document.name);
  DocumentLoader loader(splitter.head(), document.name, options, sink);
  MemberBatch batch;
  while (splitter.next(batch)) {
    if (loader.report.srs_name.empty()) loader.report.srs_name = first_srs_name(batch);
    loader.load_batch(batch);
  }
  return std::move(loader.report);
}

}  // namespace nightcity::citygml
