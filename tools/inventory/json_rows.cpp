#include "tools/inventory/json_rows.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "formats/error.h"
#include "tools/city/text_encoding.h"
#include "tools/cityjson/json.h"
#include "tools/inventory/json_columns.h"
#include "tools/inventory/loose_json.h"

namespace nightcity::inventory {
namespace {

using cityjson::find_array;
using cityjson::find_object;
using cityjson::find_text;
using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

constexpr std::string_view blanks = " \t\r\n\x1e";

bool is_list_of_objects(const array& list) {
  object first;
  return list.size() > 0 && list.at(0).get(first) == simdjson::SUCCESS;
}

bool is_list_of_lists(const array& list) {
  array first;
  return list.size() > 0 && list.at(0).get(first) == simdjson::SUCCESS;
}

bool is_list_of_texts(const array& list) {
  return list.size() > 0 && std::all_of(list.begin(), list.end(),
                                        [](const element& value) { return value.is_string(); });
}

}  // namespace

JsonRows::JsonRows(std::string text, std::string file)
    : text_(city::decode_text(std::move(text))), file_(std::move(file)) {
  if (text_.starts_with("\xef\xbb\xbf")) std::fill_n(text_.begin(), 3, ' ');
  element root;
  simdjson::error_code error = parser_.parse(text_).get(root);
  if (error != simdjson::SUCCESS) {
    in_lines_ = begins_in_lines();
    if (in_lines_) return;
    text_ = straighten_json(text_);
    simdjson::error_code still = parser_.parse(text_).get(root);
    if (still != simdjson::SUCCESS)
      why_none_ = std::string("it is broken JSON: ") + simdjson::error_message(error);
    error = still;
  }
  if (error != simdjson::SUCCESS) return;
  take_root(root);
  if (why_none_.empty() || !may_have_columns_) return;
  std::string turned = turn_into_rows(whole_, file_);
  if (turned.empty()) return;
  text_ = std::move(turned);
  why_none_.clear();
  if (parser_.parse(text_).get(root) == simdjson::SUCCESS) take_root(root);
  has_wrapper_ = false;  // what stood beside the rows is gone
}

void JsonRows::take_root(const element& root) {
  array list;
  object whole;
  if (root.get(list) == simdjson::SUCCESS)
    take_list(list);
  else if (root.get(whole) == simdjson::SUCCESS)
    find_in_object(whole);
  else
    why_none_ = "it is a single value in JSON";
}

// One object may be on each line; a broken text is no such.
bool JsonRows::begins_in_lines() const {
  simdjson::dom::parser parser;
  const std::string_view whole = text_;
  const std::size_t begin = std::min(whole.find_first_not_of(blanks), whole.size());
  const std::size_t end = std::min(whole.find('\n', begin), whole.size());
  object first;
  const std::string line(whole.substr(begin, end - begin));
  return parser.parse(line).get(first) == simdjson::SUCCESS ||
         parser.parse(straighten_json(line)).get(first) == simdjson::SUCCESS;
}

void JsonRows::take_list(const array& rows) {
  rows_ = rows;
  array names;
  begins_with_names_ = columns_.empty() && is_list_of_lists(rows) &&
                       rows.at(0).get(names) == simdjson::SUCCESS && is_list_of_texts(names);
  if (begins_with_names_)
    for (const element& name : names) columns_.push_back({cityjson::to_text(name), {}});
  else if (columns_.empty() && rows.size() > 0 && !is_list_of_objects(rows))
    why_none_ = "it is a list in JSON, but not of objects";
}

// Servers put their rows into a member, of which "result" and the like are the wrapping of CKAN and
// others.
JsonRows::Lists JsonRows::list_lists(const object& in, int depth) {
  constexpr std::array<std::string_view, 12> wrappings{"result",    "results", "response", "data",
                                                       "d",         "payload", "body",     "items",
                                                       "_embedded", "content", "hits",     "root"};
  constexpr int deepest = 4;
  Lists lists;
  for (const auto& [name, value] : in)
    if (array list; value.get(list) == simdjson::SUCCESS &&
                    (is_list_of_objects(list) || is_list_of_lists(list)))
      lists.emplace_back(name, list);
  wrapper_ = in;
  for (const std::string_view wrapping : wrappings)
    if (const auto inside = find_object(in, wrapping); inside && lists.empty() && depth < deepest)
      lists = list_lists(*inside, depth + 1);
  if (lists.empty()) wrapper_ = in;
  return lists;
}

void JsonRows::find_in_object(const object& whole) {
  constexpr std::array<std::string_view, 9> usual{
      "features", "results", "records", "rows", "items", "data", "value", "elements", "docs"};
  whole_ = whole;
  has_wrapper_ = true;
  Lists lists = list_lists(whole, 0);
  may_have_columns_ = std::none_of(lists.begin(), lists.end(), [](const auto& named) {
    return is_list_of_objects(named.second);
  });
  for (const std::string_view name : usual) {
    const auto list = find_array(wrapper_, name);
    if (!list || (list->size() > 0 && !is_list_of_objects(*list) && !is_list_of_lists(*list)))
      continue;
    lists = {{std::string(name), *list}};
    break;
  }
  if (lists.size() == 1) {
    take_columns(whole);
    if (columns_.empty()) take_columns(wrapper_);
    take_list(lists.front().second);
    return;
  }
  why_none_ = lists.empty() ? "it has no list of objects" : "it has several lists of objects:";
  for (const auto& [name, list] : lists) why_none_ += " " + name;
}

// Socrata says the names of values in {"meta": {"view": {"columns": [...]}}}, CKAN in "fields".
void JsonRows::take_columns(const object& beside) {
  const auto meta = find_object(beside, "meta");
  const auto view = meta ? find_object(*meta, "view") : std::nullopt;
  for (const char* key : {"columns", "fields"}) {
    const auto list = find_array(view ? *view : beside, key);
    if (!list || !columns_.empty()) continue;
    for (const element& value : *list) {
      ListedColumn& column = columns_.emplace_back();
      column.name = cityjson::to_text(value);
      object described;
      if (value.get(described) != simdjson::SUCCESS) continue;
      for (const char* name : {"fieldName", "id", "name"})
        if (column.name.empty()) column.name = std::string(find_text(described, name));
      if (const auto parts = find_array(described, "subColumnTypes"))
        for (const element& part : *parts) column.parts.push_back(cityjson::to_text(part));
    }
  }
}

void JsonRows::visit(const VisitRow& use) {
  if (!in_lines_) {
    bool is_row = !begins_with_names_;
    for (const element& row : rows_) {
      if (is_row) use(row);
      is_row = true;
    }
    return;
  }
  std::size_t line = 0;
  for (std::string_view rest = text_; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view one = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++line;
    one.remove_prefix(std::min(one.find_first_not_of(blanks), one.size()));
    if (one.empty()) continue;
    element row;
    simdjson::error_code error = parser_.parse(one.data(), one.size()).get(row);
    const std::string straight = error == simdjson::SUCCESS ? "" : straighten_json(one);
    if (error != simdjson::SUCCESS) error = parser_.parse(straight).get(row);
    if (error != simdjson::SUCCESS)
      throw Error(file_, line, "is broken JSON, where each line before is an object");
    use(row);
  }
}

}  // namespace nightcity::inventory
