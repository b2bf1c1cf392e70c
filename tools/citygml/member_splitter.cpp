#include "tools/citygml/member_splitter.h"

#include <algorithm>
#include <cstring>

#include "formats/error.h"

namespace nightcity::citygml {
namespace {

// Lists of members: their children are the members.
bool is_member_list(std::string_view local) {
  return local == "featureMembers" || local == "cityObjectMembers";
}

// A long member may be cut behind these elements: their parent is a plain list of them.
bool is_patch(std::string_view local) {
  return local == "Triangle" || local == "PolygonPatch";
}

// Returns the name in a start tag: "a:b" of "<a:b c='d'>".
std::string_view name_in(std::string_view tag) {
  std::size_t end = 1;
  while (!ends_name(tag[end])) ++end;
  return tag.substr(1, end - 1);
}

std::string newest_version(std::string_view root_tag) {
  std::string best;
  for (std::size_t at = root_tag.find("citygml"); at != std::string_view::npos;
       at = root_tag.find("citygml", at + 7)) {
    const std::size_t end = std::min(root_tag.find_first_of("\"' \t\r\n", at), root_tag.size());
    const std::string_view uri = root_tag.substr(at, end - at);
    for (std::size_t i = 1; i + 2 < uri.size(); ++i) {
      const bool digits = uri[i] >= '0' && uri[i] <= '9' && uri[i + 2] >= '0' && uri[i + 2] <= '9';
      if (!digits || uri[i + 1] != '.' || uri[i - 1] != '/' ||
          (i + 3 < uri.size() && uri[i + 3] != '/'))
        continue;
      best = std::max(best, std::string(uri.substr(i, 3)));
    }
  }
  return best;
}

}  // namespace

MemberSplitter::MemberSplitter(city::ByteSource& source, std::string name, const Limits& limits)
    : scanner_(source, std::move(name), limits.member_bytes), limits_(limits) {
  read_head();
}

void MemberSplitter::read_head() {
  const Tag root = scanner_.next();
  if (root.kind != Tag::Kind::open && root.kind != Tag::Kind::empty)
    throw Error(scanner_.name(), "is not XML: it has no root element");
  head_.root_tag = scanner_.window().substr(root.begin, root.end - root.begin);
  head_.root_name = root.name;
  head_.version = newest_version(head_.root_tag);
  std::string declaration(scanner_.window().substr(0, root.begin));
  std::transform(declaration.begin(), declaration.end(), declaration.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  head_.latin1 = declaration.find("iso-8859-1") != std::string::npos ||
                 declaration.find("windows-1252") != std::string::npos;
  finished_ = root.kind == Tag::Kind::empty;
  scanner_.take(root.end);
  scanner_.skip_lines(limits_.lines_left_out);
}

void MemberSplitter::close_tag(const Tag& tag) {
  const auto [begin, end] = open_.back();
  const std::string_view expected = name_in(scanner_.window().substr(begin, end - begin));
  if (expected != tag.name)
    scanner_.fail(tag.begin, "not XML: <" + std::string(expected) + "> is closed by </" +
                                 std::string(tag.name) + ">");
  open_.pop_back();
}

// Moves one tag further and adds a member that ends with it to `batch`. Returns false at the end of
// the document.
bool MemberSplitter::scan_tag(MemberBatch& batch) {
  const Tag tag = scanner_.next();
  const bool outside = open_.empty();
  if (tag.kind == Tag::Kind::end_of_file)
    scanner_.fail(scanner_.window().size(), "the file ends inside <" + head_.root_name + ">");
  if (tag.kind == Tag::Kind::close && outside) {
    const std::string& expected = list_.empty() ? head_.root_name : list_;
    if (tag.name != expected)
      scanner_.fail(tag.begin,
                    "not XML: <" + expected + "> is closed by </" + std::string(tag.name) + ">");
    if (list_.empty()) return false;
    list_.clear();
    return true;
  }
  if (outside) member_line_ = scanner_.line_of(tag.begin);
  if (tag.kind == Tag::Kind::open) {
    if (outside && list_.empty() && is_member_list(local_name(tag.name))) {
      list_ = tag.name;
      return true;
    }
    if (outside && !limits_.every_tag) {
      const std::string name(local_name(tag.name));
      if (const std::size_t end = scanner_.skip_element(tag, limits_.piece_bytes); end > 0) {
        batch.members.push_back({tag.begin, end - tag.begin, member_line_, name, false});
        return true;
      }
    }
    if (open_.size() >= limits_.depth)
      scanner_.fail(tag.begin, "elements nest deeper than any CityGML does");
    open_.emplace_back(tag.begin, tag.end);
    return true;
  }
  const std::size_t begin = outside ? tag.begin : open_.front().first;
  if (tag.kind == Tag::Kind::close) close_tag(tag);
  if (open_.empty()) {
    const std::string_view name = name_in(scanner_.window().substr(begin, tag.end - begin));
    batch.members.push_back(
        {begin, tag.end - begin, member_line_, std::string(local_name(name)), continued_});
    continued_ = false;
  } else if (tag.end - begin > limits_.piece_bytes && is_patch(local_name(tag.name))) {
    cut_ = tag.end;
  }
  return true;
}

void MemberSplitter::pass_on(MemberBatch& batch, std::size_t end) {
  batch.bytes = scanner_.take(end);
  for (Range& range : open_) range = {range.first - end, range.second - end};
  if (cut_ > 0) cut_ -= end;
}

// Closes the elements open at the cut for this piece, and opens them again for the next.
void MemberSplitter::pass_on_piece(MemberBatch& batch) {
  const std::string_view window = scanner_.window();
  std::string openers, closers;
  std::vector<Range> reopened;
  for (const auto& [begin, end] : open_) {
    const std::string_view tag = window.substr(begin, end - begin);
    reopened.emplace_back(openers.size(), openers.size() + tag.size());
    openers += tag;
    closers = "</" + std::string(name_in(tag)) + ">" + closers;
  }
  const std::size_t begin = open_.front().first, length = cut_ - begin;
  const std::string name(local_name(name_in(window.substr(begin))));
  batch.members.push_back({0, length + closers.size(), member_line_, name, continued_});
  continued_ = true;
  batch.bytes = std::make_unique_for_overwrite<char[]>(length + closers.size());
  std::memcpy(batch.bytes.get(), window.data() + begin, length);
  std::memcpy(batch.bytes.get() + length, closers.data(), closers.size());
  scanner_.replace(cut_, openers);
  open_ = std::move(reopened);
  cut_ = 0;
}

// Passes the text in front of the next tag. Text between members is not kept, however long it is:
// blanks by the gigabyte are a small file when they are gzipped. Returns false where the batch has
// to be passed on before that.
bool MemberSplitter::passes_text(const MemberBatch& batch) {
  while (open_.empty() && !scanner_.sees_markup()) {
    if (!batch.members.empty()) return false;
    if (!scanner_.drop_text()) return true;
  }
  return true;
}

MemberSplitter::Limits limits_of(const city::ReadOptions& options) {
  MemberSplitter::Limits limits;
  limits.member_bytes = options.max_member_bytes();
  limits.piece_bytes = std::min(limits.piece_bytes, limits.member_bytes);
  if (options.piece) limits.lines_left_out = options.piece->lines_left_out;
  return limits;
}

// Behind the root element XML allows comments alone. Another element is another document, whose
// objects would be lost.
void MemberSplitter::refuse_second_document() {
  for (;;) {
    while (!scanner_.sees_markup())
      if (!scanner_.drop_text()) return;
    const Tag tag = scanner_.next();
    if (tag.kind == Tag::Kind::end_of_file) return;
    if (tag.kind != Tag::Kind::close && local_name(tag.name) == local_name(head_.root_name))
      scanner_.fail(tag.begin, "a second <" + head_.root_name +
                                   "> in one file: cut it in two there, and name both");
  }
}

bool MemberSplitter::next(MemberBatch& batch) {
  batch.members.clear();
  batch.first_member = delivered_;
  while (!finished_ && cut_ == 0) {
    if (!passes_text(batch)) break;
    finished_ = !scan_tag(batch);
    const bool full =
        !batch.members.empty() && open_.empty() && scanner_.position() >= limits_.batch_bytes;
    if (full) break;
  }
  if (!batch.members.empty()) {
    delivered_ += batch.members.size();
    pass_on(batch, batch.members.back().begin + batch.members.back().size);
    return true;
  }
  if (cut_ > 0) {
    ++delivered_;
    pass_on_piece(batch);
    return true;
  }
  refuse_second_document();
  return false;
}

}  // namespace nightcity::citygml
