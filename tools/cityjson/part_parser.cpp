#include "tools/cityjson/part_parser.h"

#include "formats/error.h"
#include "tools/cityjson/document_index.h"
#include "tools/cityjson/document_text.h"

namespace nightcity::cityjson {

std::vector<dom::element> PartParser::parse(std::span<const std::string_view> parts) {
  const dom::array array = parse_inside(parts);
  return {array.begin(), array.end()};
}

dom::array PartParser::parse_inside(std::span<const std::string_view> parts) {
  std::size_t bytes = 0;
  for (const std::string_view part : parts) bytes += part.size();
  if (bytes > max_bytes_) refuse_long_part(name_, find_line(parts), "part", max_bytes_);
  buffer_ = "[";
  for (const std::string_view part : parts) {
    if (buffer_.size() > 1) buffer_ += ',';
    buffer_ += part;
  }
  buffer_ += ']';
  const std::size_t size = buffer_.size();
  buffer_.resize(size + simdjson::SIMDJSON_PADDING, ' ');
  dom::element array;
  if (const auto error = parse_text(parser_, std::string_view(buffer_).substr(0, size), array))
    throw Error(name_, find_line(parts),
                std::string("not JSON: ") + simdjson::error_message(error));
  return array;
}

std::size_t PartParser::find_line(std::span<const std::string_view> parts) const {
  return line_of(text_, static_cast<std::size_t>(parts.front().data() - text_.data()));
}

}  // namespace nightcity::cityjson
