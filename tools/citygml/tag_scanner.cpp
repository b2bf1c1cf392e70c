#include "tools/citygml/tag_scanner.h"

#include <algorithm>
#include <cstring>

#include "formats/error.h"
#include "tools/city/find_name.h"
#include "tools/city/line_ends.h"

namespace nightcity::citygml {
namespace {

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
// Read at once: a large document's block, which a small document's first ones lead up to.
constexpr std::size_t first_block = std::size_t{1} << 15, read_block = std::size_t{1} << 20;

}  // namespace

std::string_view local_name(std::string_view name) {
  if (name.empty()) return name;
  const void* const colon = ::memrchr(name.data(), ':', name.size());
  return colon ? name.substr(
                     static_cast<std::size_t>(static_cast<const char*>(colon) - name.data()) + 1)
               : name;
}

bool ends_name(char c) {
  return c == '>' || c == '/' || is_space(c);
}

TagScanner::TagScanner(city::ByteSource& source, std::string name, std::size_t max_window)
    : source_(source), name_(std::move(name)), max_window_(max_window), block_(first_block) {
  skip_byte_order_mark();
}

void TagScanner::skip_byte_order_mark() {
  while (size_ < 4 && fill()) {
  }
  const std::string_view start = window();
  if (start.empty()) throw Error(name_, "is empty");
  if (start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff") ||
      start.substr(0, 4).find('\0') != std::string_view::npos)
    throw Error(name_, "is not UTF-8 (UTF-16 or binary)");
  if (start.starts_with("\xef\xbb\xbf")) position_ = 3;
  std::size_t content = position_;
  while (content < size_ && is_space(bytes_[content])) ++content;
  if (content == size_ || bytes_[content] != '<') throw Error(name_, "is not XML");
  begun_ = true;
  refuse_zero_bytes(0);
}

// No XML holds a zero byte (XML 1.0, 2.2). The holes of a sparse file are read as such, without
// end.
void TagScanner::refuse_zero_bytes(std::size_t from) {
  if (const void* at = std::memchr(bytes_.get() + from, 0, size_ - from))
    fail(static_cast<std::size_t>(static_cast<const char*>(at) - bytes_.get()),
         "not XML: a zero byte (a download that was not completed?)");
}

void TagScanner::fail(std::size_t at, const std::string& message) {
  throw Error(name_, line_of(std::min(at, size_)), message);
}

std::size_t TagScanner::line_of(std::size_t at) {
  if (at <= line_at_) return line_;
  line_ += city::count_line_ends({bytes_.get() + line_at_, at - line_at_});
  line_at_ = at;
  return line_;
}

// Reads as many bytes again as are pending, at least a block: scanning a long construct anew then
// takes linear time in all.
bool TagScanner::fill() {
  if (size_ > max_window_)
    fail(position_, "an element or comment longer than " + std::to_string(max_window_ >> 20) +
                        " MB is refused: if it is right, raise [city] max_member_mb in a recipe");
  const std::size_t want = std::max(block_, size_ - position_);
  block_ = std::min(2 * block_, read_block);
  if (size_ + want > capacity_) {
    capacity_ = std::max(size_ + want, capacity_ + capacity_ / 2);
    auto larger = std::make_unique_for_overwrite<char[]>(capacity_);
    if (size_ > 0) std::memcpy(larger.get(), bytes_.get(), size_);
    bytes_ = std::move(larger);
  }
  const std::size_t got = source_.read(bytes_.get() + size_, want);
  size_ += got;
  if (begun_) refuse_zero_bytes(size_ - got);
  return got > 0;
}

bool TagScanner::sees_markup() const {
  return position_ < size_ && std::memchr(bytes_.get() + position_, '<', size_ - position_);
}

bool TagScanner::drop_text() {
  position_ = size_;
  take(size_);
  return fill();
}

std::size_t TagScanner::find(char c, std::size_t from) {
  for (;;) {
    if (from < size_) {
      if (const void* at = std::memchr(bytes_.get() + from, c, size_ - from))
        return static_cast<std::size_t>(static_cast<const char*>(at) - bytes_.get());
      from = size_;
    }
    if (!fill()) return nowhere;
  }
}

std::size_t TagScanner::find(std::string_view text, std::size_t from) {
  for (;;) {
    const auto at = window().find(text, from);
    if (at != std::string_view::npos) return at;
    from = std::max(from, size_ >= text.size() ? size_ - text.size() + 1 : 0);
    if (!fill()) return nowhere;
  }
}

// Returns the position behind the '>' that closes the tag: one inside quotes does not count. Every
// byte is looked at a fixed number of times, however many attributes there are.
std::size_t TagScanner::end_of_tag(std::size_t begin) {
  std::size_t from = begin + 1, close = begin;
  const auto refuse_tags = [&](std::size_t end) {
    if (window().substr(from, end - from).find('<') != std::string_view::npos)
      fail(begin, "not XML: '<' inside a tag");
  };
  for (;;) {
    if (close < from) close = find('>', from);
    if (close == nowhere) fail(begin, "the file ends inside a tag");
    const std::size_t quote = window().substr(0, close).find_first_of("\"'", from);
    if (quote == std::string_view::npos) {
      refuse_tags(close);
      return close + 1;
    }
    const std::size_t unquote = find(bytes_[quote], quote + 1);
    if (unquote == nowhere) fail(begin, "the file ends inside an attribute");
    refuse_tags(unquote);
    from = unquote + 1;
  }
}

void TagScanner::skip_declaration(std::size_t begin) {
  while (size_ - begin < 9 && fill()) {
  }
  const std::string_view text = window().substr(begin);
  std::size_t end = nowhere;
  if (text.starts_with("<!--"))
    end = find("-->", begin + 4);
  else if (text.starts_with("<![CDATA["))
    end = find("]]>", begin + 9);
  else if (text.starts_with("<!DOCTYPE"))
    fail(begin, "a DOCTYPE is refused: it may name other files and entities without bound");
  else
    fail(begin, "not XML");
  if (end == nowhere) fail(begin, "the file ends inside a comment");
  position_ = end + 3;
}

Tag TagScanner::next() {
  for (;;) {
    const std::size_t begin = find('<', position_);
    if (begin == nowhere) return {};
    position_ = begin;
    if (begin + 1 >= size_ && !fill()) fail(begin, "the file ends inside a tag");
    const char c = bytes_[begin + 1];
    if (c == '!') {
      skip_declaration(begin);
      continue;
    }
    if (c == '?') {
      const std::size_t end = find("?>", begin + 2);
      if (end == nowhere) fail(begin, "the file ends inside a processing instruction");
      position_ = end + 2;
      continue;
    }
    Tag tag;
    tag.begin = begin;
    tag.end = end_of_tag(begin);
    const std::size_t first = begin + (c == '/' ? 2 : 1);
    std::size_t last = first;
    while (!ends_name(bytes_[last])) ++last;
    if (last == first) fail(begin, "not XML: a tag without a name");
    tag.name = window().substr(first, last - first);
    const bool empty = bytes_[tag.end - 2] == '/';
    tag.kind = c == '/' ? Tag::Kind::close : empty ? Tag::Kind::empty : Tag::Kind::open;
    position_ = tag.end;
    return tag;
  }
}

std::size_t TagScanner::skip_element(const Tag& open, std::size_t max_bytes) {
  const std::string name(open.name);
  std::size_t from = open.end, end = 0;
  while (end == 0) {
    const std::size_t at = city::find_name(window(), name, from);
    const std::size_t behind = at + name.size();
    if (at == std::string_view::npos || behind >= size_) {
      from = std::max(from, size_ - std::min(size_, name.size()));
      if (size_ - open.begin > max_bytes || !fill()) return 0;
      continue;
    }
    from = behind;
    if (!ends_name(bytes_[behind])) continue;
    const std::string_view before = window().substr(open.end, at - open.end);
    if (before.ends_with('<')) return 0;
    if (before.ends_with("</")) end = at - 2;
  }
  // "<!--", "<![CDATA[", "<?": rare enough to look for one by one.
  const char* const text = bytes_.get();
  for (const char mark : {'!', '?'}) {
    for (std::size_t at = open.end; at < end; ++at) {
      const void* found = std::memchr(text + at, mark, end - at);
      if (!found) break;
      at = static_cast<std::size_t>(static_cast<const char*>(found) - text);
      if (text[at - 1] == '<') return 0;
    }
  }
  position_ = end_of_tag(end);
  return position_;
}

std::unique_ptr<char[]> TagScanner::rebase(std::size_t end, std::string_view in_front) {
  line_of(end);
  const std::size_t rest = size_ - end;
  capacity_ = in_front.size() + rest + 2 * block_;
  auto next = std::make_unique_for_overwrite<char[]>(capacity_);
  if (!in_front.empty()) std::memcpy(next.get(), in_front.data(), in_front.size());
  std::memcpy(next.get() + in_front.size(), bytes_.get() + end, rest);
  std::swap(bytes_, next);
  size_ = in_front.size() + rest;
  position_ = position_ - end + in_front.size();
  line_at_ = line_at_ - end + in_front.size();
  return next;
}

std::unique_ptr<char[]> TagScanner::take(std::size_t end) {
  return rebase(end, {});
}
void TagScanner::replace(std::size_t end, std::string_view text) {
  rebase(end, text);
}

}  // namespace nightcity::citygml
