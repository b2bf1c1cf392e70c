// Finds the parts of a CityJSON document in its text, so that no more than one part at a time has
// to be parsed: a document may be larger than the memory that its parsed form needs.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::cityjson {

struct ObjectText {
  std::string_view id;        // as it is in the text, escapes too
  std::string_view type;      // the same, without quotes; "" = none
  std::string_view children;  // an array of ids; "" = none
  std::string_view parent;    // the first of its parents, as id is
  std::string_view value;     // the whole object
};

struct DocumentIndex {
  std::map<std::string, std::string_view, std::less<>> members;  // all but the city objects
  std::vector<ObjectText> objects;                               // in the order of the text
};

/// `text` must outlive the index. Brackets and texts are followed, and what stands between is left
/// to the parser. Throws Error with file and line where the text is no JSON object, or is cut off.
DocumentIndex index_document(std::string_view text, const std::string& name);

/// Returns the line, from 1, of a place in the text.
std::size_t line_of(std::string_view text, std::size_t place);

/// Finds the end of the first JSON value of a text that comes in blocks.
class ValueEnd {
 public:
  /// Returns the number of bytes up to the value's end, or npos where it goes on behind the block.
  std::size_t find(std::string_view block);

 private:
  std::size_t depth_ = 0;
  bool in_text_ = false, escaped_ = false;
};

}  // namespace nightcity::cityjson
