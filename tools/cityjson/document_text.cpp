#include "tools/cityjson/document_text.h"

#include <simdjson.h>

#include <algorithm>
#include <memory>

#include "formats/error.h"
#include "tools/city/line_ends.h"
#include "tools/city/text_encoding.h"
#include "tools/cityjson/document_index.h"

namespace nightcity::cityjson {
namespace {

// Blocks become as large as this. The first is small, because a small file is to cost little.
constexpr std::size_t block_bytes = std::size_t{1} << 18;
constexpr std::size_t first_block_bytes = std::size_t{1} << 15;
// The first line of a CityJSONSeq holds no city object; one longer than this is a CityJSON.
constexpr std::size_t max_first_line = std::size_t{64} << 20;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

// Returns whether a line begins with a feature. No other form of CityJSON has one there.
bool begins_feature(std::string_view text) {
  constexpr std::size_t enough = 4096;
  const std::string_view line = text.substr(0, std::min(text.find('\n'), enough));
  return line.starts_with('{') && line.find("\"CityJSONFeature\"") != line.npos;
}

// The first line of a sequence is a value of its own, and more follows; or it was to be one.
bool begins_sequence(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  std::string_view start = text.substr(begin, max_first_line);
  if (start.starts_with(record_separator)) start.remove_prefix(1);
  const std::size_t end = start.find('\n');
  if (end == std::string_view::npos || is_blank(start.substr(end))) return false;
  return begins_feature(start.substr(end + 1)) ||
         ValueEnd().find(start.substr(0, end)) != std::string_view::npos;
}

}  // namespace

void refuse_long_part(const std::string& name, std::size_t line, const std::string& what,
                      std::size_t max_bytes) {
  throw Error(name, line,
              "a " + what + " of more than " + std::to_string(max_bytes >> 20) +
                  " MB is refused: if it is right, raise [city] max_member_mb in a recipe");
}

DocumentText::DocumentText(const city::Document& document, bool on_disk) {
  if (on_disk) {
    mapped_.emplace(document.name);
    const auto bytes = mapped_->bytes();
    text_ = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    if (city::begins_as_utf16(text_) || city::begins_as_utf32(text_)) {
      mapped_.reset();
      hold(document);
    }
  } else {
    hold(document);
  }
  if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
  is_sequence_ = is_sequence_ || begins_sequence(text_);
}

void DocumentText::hold(const city::Document& document) {
  const auto source = document.open();
  bool looked = false;
  for (std::size_t wanted = first_block_bytes;; wanted = std::min(2 * wanted, block_bytes)) {
    const std::size_t size = held_.size();
    held_.resize(size + wanted);
    const std::size_t got = source->read(held_.data() + size, wanted);
    held_.resize(size + got);
    if (got == 0) break;
    // Looked at once, early: a long CityJSONSeq must not be read to its end for this.
    if (looked || held_.size() < 4 * block_bytes) continue;
    looked = true;
    is_sequence_ = begins_sequence(held_);
    if (is_sequence_) break;
  }
  text_ = held_;
}

std::optional<LineReader::Lines> LineReader::next() {
  if (at_end_) return {};
  constexpr std::size_t padding = simdjson::SIMDJSON_PADDING;
  Lines lines;
  lines.first_line = line_;
  const char* held = rest_.data();
  std::size_t size = rest_.size(), end = std::string_view::npos;  // the end of the last whole line
  while (end == std::string_view::npos) {
    if (size > max_line_) refuse_long_part(name_, line_, "line", max_line_);
    block_ = std::clamp(2 * block_, first_block_bytes, block_bytes);
    const std::size_t wanted = std::max(block_, size);
    // Bytes that are read over need not be cleared first.
    auto larger = std::make_unique_for_overwrite<char[]>(size + wanted + padding);
    std::copy_n(held, size, larger.get());
    lines.bytes = std::move(larger);
    held = lines.bytes.get();
    const std::size_t got = source_->read(lines.bytes.get() + size, wanted);
    const std::size_t feed = std::string_view(held + size, got).rfind('\n');
    if (feed != std::string_view::npos) end = size + feed + 1;
    size += got;
    if (got > 0) continue;
    at_end_ = true;
    end = size;
  }
  lines.size = end;
  rest_.assign(held + end, size - end);
  line_ += city::count_line_ends(lines.text());
  std::fill_n(lines.bytes.get() + end, padding, ' ');
  if (lines.first_line == 1 && lines.text().starts_with(byte_order_mark))
    std::fill_n(lines.bytes.get(), byte_order_mark.size(), ' ');
  return lines;
}

}  // namespace nightcity::cityjson
