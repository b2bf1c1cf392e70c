// The rows that a text in JSON holds, in whatever they are wrapped.
#pragma once

#include <simdjson.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nightcity::inventory {

/// Called with each row: an object, or a list of values where there are names of columns.
using VisitRow = std::function<void(const simdjson::dom::element&)>;

/// The name of a value in rows that are lists, and those of its parts where it is a list itself.
struct ListedColumn {
  std::string name;
  std::vector<std::string> parts;
};

class JsonRows {
 public:
  /// `file` is for messages.
  JsonRows(std::string text, std::string file);

  /// Returns why there are no rows; "" where there are some.
  const std::string& why_none() const { return why_none_; }
  /// Visits all rows, as often as is asked. Throws Error where a line is broken JSON.
  void visit(const VisitRow& use);
  /// Returns the names of the values where rows are lists.
  const std::vector<ListedColumn>& columns() const { return columns_; }
  /// Returns the object that the rows lie in; null where they are a list or lines.
  const simdjson::dom::object* wrapper() const { return has_wrapper_ ? &wrapper_ : nullptr; }
  /// Returns the whole where it is an object; null elsewhere.
  const simdjson::dom::object* whole() const { return has_wrapper_ ? &whole_ : nullptr; }

 private:
  bool begins_in_lines() const;
  void take_root(const simdjson::dom::element& root);
  void take_list(const simdjson::dom::array& rows);
  using Lists = std::vector<std::pair<std::string, simdjson::dom::array>>;
  void find_in_object(const simdjson::dom::object& whole);
  // Returns the lists in an object or in what wraps them there, which becomes the wrapper.
  Lists list_lists(const simdjson::dom::object& in, int depth);
  void take_columns(const simdjson::dom::object& beside);

  std::string text_, file_, why_none_;
  simdjson::dom::parser parser_;
  simdjson::dom::array rows_;
  simdjson::dom::object whole_, wrapper_;
  bool has_wrapper_ = false, in_lines_ = false, begins_with_names_ = false;
  bool may_have_columns_ = false;  // it is an object without a list of objects
  std::vector<ListedColumn> columns_;
};

}  // namespace nightcity::inventory
