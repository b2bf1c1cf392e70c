#include "tools/cityjson/read_cityjson.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/cityjson/api_answer.h"
#include "tools/cityjson/document_reader.h"
#include "tools/cityjson/document_text.h"
#include "tools/cityjson/sequence_reader.h"

namespace nightcity::cityjson {
namespace {

constexpr std::size_t start_bytes = 65536;

std::string_view skip_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

// Returns whether a member of that name, in quotes, has a value that begins as `begins` says.
template <class Begins>
bool has_member(std::string_view text, std::string_view key, const Begins& begins) {
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1)) {
    const std::string_view behind = skip_blanks(text.substr(at + key.size()));
    if (behind.starts_with(':') && begins(skip_blanks(behind.substr(1)))) return true;
  }
  return false;
}

// Puts the sequence that a server's answer holds in its place.
void unwrap_answers(std::vector<city::Document>& documents, const city::ReadOptions& options,
                    std::vector<std::string>* warnings) {
  for (city::Document& document : documents) {
    std::optional<ApiAnswer> answer = read_api_answer(document, options.max_member_bytes());
    if (!answer) continue;
    if (warnings && !answer->missing.empty())
      warnings->push_back(document.name + ": " + answer->missing);
    document = std::move(answer->sequence);
  }
}

// Archives also hold metadata, schemas and code lists in JSON.
std::vector<city::Document> list_cityjson(const std::filesystem::path& file,
                                          const city::ReadOptions& options,
                                          std::vector<std::string>* warnings) {
  std::vector<city::Document> all = city::list_documents(file, cityjson_endings);
  unwrap_answers(all, options, warnings);
  if (all.size() == 1) return all;
  std::vector<city::Document> documents;
  for (city::Document& document : all) {
    if (begins_as_cityjson(city::read_start(document, start_bytes)))
      documents.push_back(std::move(document));
    else if (warnings)
      warnings->push_back(document.name + ": passed over, it is no CityJSON");
  }
  if (documents.empty()) throw Error(file.string(), "the archive holds no CityJSON");
  return documents;
}

}  // namespace

bool begins_as_cityjson(std::string_view start) {
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  if (start.starts_with(record_separator)) start.remove_prefix(1);
  start = skip_blanks(start);
  if (!start.starts_with('{')) return false;
  // Members come in any order, and one may fill the whole start. Of members of these names, or of
  // these places, no other format knows.
  if (skip_blanks(start.substr(1)).starts_with("\"appearance\"")) return true;
  for (const std::string_view key : {"\"CityObjects\"", "\"geometry-templates\""})
    if (start.find(key) != std::string_view::npos) return true;
  return has_member(start, "\"type\"",
                    [](std::string_view value) {
                      return value.starts_with("\"CityJSON\"") ||
                             value.starts_with("\"CityJSONFeature\"");
                    }) ||
         // Other formats have numbers alone in such an array.
         has_member(start, "\"vertices\"", [](std::string_view value) {
           return value.starts_with('[') && skip_blanks(value.substr(1)).starts_with('[');
         });
}

city::CityHead read_cityjson_head(const std::filesystem::path& file,
                                  const city::ReadOptions& options) {
  city::CityHead head;
  for (const city::Document& document : list_cityjson(file, options, nullptr)) {
    const DocumentText content(document, !document.packed);
    city::CityHead one = content.is_sequence()
                             ? read_sequence_head(document, options)
                             : read_document_head(content.text(), document.name, options);
    if (head.version.empty()) head.version = one.version;
    if (head.srs_name.empty()) head.srs_name = one.srs_name;
    head.sample = std::move(one.sample);
    if (!head.sample.empty()) break;
  }
  return head;
}

city::ReadReport read_cityjson_document(const city::Document& document, bool on_disk,
                                        const city::ReadOptions& options,
                                        const city::ObjectStage& stage) {
  std::optional<DocumentText> content(std::in_place, document, on_disk);
  if (!content->is_sequence()) return read_document(content->text(), document.name, options, stage);
  content.reset();
  return read_sequence(document, options, stage);
}

city::ReadReport read_cityjson_staged(const std::filesystem::path& file,
                                      const city::ReadOptions& options,
                                      const city::ObjectStage& stage) {
  city::ReadReport report;
  for (const city::Document& document : list_cityjson(file, options, &report.warnings))
    report.merge(read_cityjson_document(document, !document.packed, options, stage));
  city::finish_report(file, report);
  return report;
}

}  // namespace nightcity::cityjson
