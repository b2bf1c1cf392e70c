#include "tools/inputs/read_city.h"

#include <fmt/format.h>

#include <string>

#include "formats/error.h"
#include "tools/city/byte_source.h"
#include "tools/city/foreign_format.h"
#include "tools/city/text_encoding.h"
#include "tools/inputs/file_format.h"

namespace nightcity::inputs {
namespace {

const city::FileReader& find_reader(const std::filesystem::path& file, const FileFormat& format) {
  const char* const remedy = format.kind == FileKind::scene
                                 ? ": a model is exported as Wavefront OBJ (Blender does), a "
                                   "finished scene is shown by nightview"
                                 : "";
  if (!format.reader)
    throw Error(file.string(), "is no city model but " + std::string(format.name) + remedy);
  return *format.reader;
}

// Returns the name of a document's format, else of what its XML is, else how its name ends.
std::string name_kind(const city::Document& document, const FileFormat* format) {
  if (format) return std::string(format->name);
  const std::string start = city::read_start(document, std::size_t{1} << 16);
  const std::string_view root = city::find_root_name(start);
  if (!root.empty()) return city::to_valid_utf8("<" + std::string(root) + ">");
  return city::to_valid_utf8(std::filesystem::path(document.name).extension().string());
}

// An archive is read by the reader of its first city model, and what this one does not know is
// passed over.
void tell_passed_over(const std::filesystem::path& file, const city::FileContents& contents,
                      const FileFormat& read, city::ReadReport& report) {
  if (const auto& packed = contents.packed_entries; !packed.empty())
    report.warnings.push_back(fmt::format(
        "{}: {} packed files inside were passed over (first {}): unpack the archive, and name what "
        "is inside",
        file.string(), packed.size(), packed.front()));
  for (const auto& [ending, count] : contents.others)
    report.passed_over[city::to_valid_utf8(ending)] += count;
  if (contents.documents.size() < 2) return;
  std::size_t others = 0;
  std::string first;
  for (const city::Document& document : contents.documents) {
    const FileFormat* format = find_format(document);
    if (format == &read) continue;
    ++report.passed_over[name_kind(document, format)];
    if (!format || format->kind != FileKind::city) continue;
    if (others++ == 0) first = document.name + " is " + format->name;
  }
  if (others > 0)
    report.warnings.push_back(fmt::format(
        "{}: {} city models of other formats than {} inside were passed over ({}): unpack the "
        "archive, and name what is inside",
        file.string(), others, read.name, first));
}

}  // namespace

city::CityHead read_city_head(const std::filesystem::path& file, const city::ReadOptions& options) {
  return find_reader(file, find_format(file)).read_head(file, options);
}

city::ReadReport read_city(const std::filesystem::path& file, const city::ReadOptions& options,
                           const city::ObjectSink& sink) {
  return read_city_staged(file, options, city::deliver_to(sink));
}

city::ReadReport read_city_staged(const std::filesystem::path& file,
                                  const city::ReadOptions& options,
                                  const city::ObjectStage& stage) {
  const city::FileContents contents = list_readable(file);
  const FileFormat& format = find_format(contents.documents);
  city::ReadReport report = find_reader(file, format).read(file, options, stage);
  if (!options.piece) tell_passed_over(file, contents, format, report);
  return report;
}

std::optional<city::FileCuts> find_cuts(const std::filesystem::path& file) {
  const city::FileReader& reader = find_reader(file, find_format(file));
  return reader.find_cuts ? reader.find_cuts(file) : std::nullopt;
}

}  // namespace nightcity::inputs
