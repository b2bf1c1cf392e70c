// Parses parts of a document that is too large to be parsed as one.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/cityjson/json.h"

namespace nightcity::cityjson {

/// Parses parts of a text, joined by commas in an array of their own.
class PartParser {
 public:
  /// `name`: of the document, for messages. `max_bytes`: of the parts of a call. Both `text` and
  /// `name` must outlive the object.
  PartParser(std::string_view text, const std::string& name, std::size_t max_bytes)
      : text_(text), name_(name), max_bytes_(max_bytes) {}

  /// Returns the values of parts that hold one each. They live until the next call. Throws Error
  /// with the line of the first part where they are no JSON or have too many bytes.
  std::vector<dom::element> parse(std::span<const std::string_view> parts);
  /// The same for parts that hold several values each, with commas between.
  dom::array parse_inside(std::span<const std::string_view> parts);

 private:
  std::size_t find_line(std::span<const std::string_view> parts) const;

  std::string_view text_;
  const std::string& name_;
  std::size_t max_bytes_;
  dom::parser parser_;
  std::string buffer_;
};

}  // namespace nightcity::cityjson
