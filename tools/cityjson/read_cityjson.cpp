#include "tools/cityjson/read_cityjson.h"

#include <optional>
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
  if (!skip_blanks(start).starts_with('{')) return false;
  // Members come in any order, but of a member of that name no other format knows.
  if (start.find("\"CityObjects\"") != std::string_view::npos) return true;
  constexpr std::string_view key = "\"type\"";
  for (std::size_t at = start.find(key); at != std::string_view::npos;
       at = start.find(key, at + 1)) {
    std::string_view value = skip_blanks(start.substr(at + key.size()));
    if (!value.starts_with(':')) continue;
    value = skip_blanks(value.substr(1));
    if (value.starts_with("\"CityJSON\"") || value.starts_with("\"CityJSONFeature\"")) return true;
  }
  return false;
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
