#include "tools/cityjson/api_answer.h"

#include <simdjson.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include "tools/city/text_encoding.h"
#include "tools/cityjson/document_index.h"
#include "tools/cityjson/document_text.h"
#include "tools/cityjson/json.h"

namespace nightcity::cityjson {
namespace {

constexpr std::size_t bytes_that_tell = 65536;

// Keeps other documents, which may be long, from being read for this. An answer has its features in
// one value, a sequence has them behind the first, whatever key that begins with.
bool begins_as_answer(std::string_view start) {
  const std::size_t feature = start.find("\"CityJSONFeature\"");
  if (feature == start.npos || feature > ValueEnd().find(start)) return false;
  const std::size_t brace = start.find('{');
  if (brace == start.npos) return false;
  start.remove_prefix(std::min(start.find('"', brace), start.size()));
  constexpr std::array<std::string_view, 9> keys{
      "\"feature\"", "\"features\"",      "\"metadata\"",       "\"id\"",       "\"links\"",
      "\"type\"",    "\"numberMatched\"", "\"numberReturned\"", "\"timeStamp\""};
  const auto begins = [&](std::string_view key) { return start.starts_with(key); };
  const auto key = std::find_if(keys.begin(), keys.end(), begins);
  if (key == keys.end()) return false;
  const std::string_view value = start.substr(key->size(), 40);
  return *key != "\"type\"" || value.find("\"FeatureCollection\"") != value.npos;
}

std::optional<double> find_number(const dom::object& object, std::string_view key) {
  const auto value = find_member(object, key);
  return value ? to_number(*value) : std::nullopt;
}

bool has_next_page(const dom::object& answer) {
  const auto links = find_array(answer, "links");
  if (!links) return false;
  return std::any_of(links->begin(), links->end(), [](const dom::element& link) {
    dom::object object;
    return link.get(object) == simdjson::SUCCESS && find_text(object, "rel") == "next";
  });
}

std::string find_what_is_missing(const dom::object& answer) {
  const std::string remedy =
      ": ask it for the others (limit and offset, or the link \"next\"), and name all answers";
  const auto matched = find_number(answer, "numberMatched"),
             returned = find_number(answer, "numberReturned");
  if (matched && returned && *matched > *returned)
    return "incomplete: the server gave " + to_text(*find_member(answer, "numberReturned")) +
           " of " + to_text(*find_member(answer, "numberMatched")) + " features" + remedy;
  return has_next_page(answer) ? "incomplete: the server gave one page of several" + remedy : "";
}

}  // namespace

std::optional<ApiAnswer> read_api_answer(const city::Document& document, std::size_t max_bytes) {
  if (!begins_as_answer(city::read_start(document, bytes_that_tell))) return {};
  std::string text = city::read_next(*document.open(), max_bytes + 1);
  if (text.size() > max_bytes) refuse_long_part(document.name, 1, "server's answer", max_bytes);
  text.erase(0, text.find('{'));  // a byte order mark
  const std::size_t size = text.size();
  text.resize(size + simdjson::SIMDJSON_PADDING, ' ');
  dom::parser parser;
  dom::element value;
  dom::object answer;
  if (parse_text(parser, std::string_view(text).substr(0, size), value) ||
      value.get(answer) != simdjson::SUCCESS)
    return {};
  const auto header = find_object(answer, "metadata");
  if (!header || find_text(*header, "type") != "CityJSON") return {};
  auto lines = std::make_shared<std::string>(simdjson::minify(*header) + "\n");
  const auto add = [&](const dom::element& feature) { *lines += simdjson::minify(feature) + "\n"; };
  if (const auto feature = find_member(answer, "feature")) add(*feature);
  if (const auto features = find_array(answer, "features"))
    for (const dom::element& feature : *features) add(feature);
  ApiAnswer result;
  result.missing = find_what_is_missing(answer);
  result.sequence.name = document.name;
  result.sequence.packed = true;
  result.sequence.open = [lines] { return city::resume(*lines, nullptr); };
  return result;
}

}  // namespace nightcity::cityjson
