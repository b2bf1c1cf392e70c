#include "tools/citygml/citygml_cuts.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "tools/city/text_encoding.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/read_citygml.h"

namespace nightcity::citygml {
namespace {

// The file's first bytes, in which the first member has to begin.
constexpr std::size_t searched_bytes = std::size_t{1} << 20;

bool holds_one_member(std::string_view local) {
  return local == "cityObjectMember" || local == "featureMember" || local == "member";
}

// Returns "<core:cityObjectMember" as the first member behind `from` is written; "" where there is
// none, or where members stand in lists.
std::string find_member_mark(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find('<', from); at != std::string_view::npos;
       at = text.find('<', at + 1)) {
    std::size_t end = at + 1;
    while (end < text.size() && !ends_name(text[end])) ++end;
    if (end == text.size()) break;
    const std::string_view name = text.substr(at + 1, end - at - 1);
    const std::string_view local = local_name(name);
    if (local == "featureMembers" || local == "cityObjectMembers") break;
    if (holds_one_member(local)) return std::string(text.substr(at, end - at));
  }
  return {};
}

std::size_t find_mark(std::string_view text, std::string_view mark, std::size_t from) {
  std::size_t at = text.find(mark, from);
  while (!ends_name(text[at + mark.size()])) at = text.find(mark, at + 1);
  return at;
}

// Returns the number of elements in the root; nothing where the text is no XML, as where the first
// member stands in a comment.
std::optional<std::size_t> count_members(std::string text, const std::string& name) {
  try {
    const auto source = city::resume(std::move(text), nullptr);
    MemberSplitter splitter(*source, name, {});
    MemberBatch batch;
    std::size_t count = 0;
    while (splitter.next(batch)) count += batch.members.size();
    return count;
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

std::optional<city::FileCuts> find_citygml_cuts(const std::filesystem::path& file) {
  const auto documents = city::list_documents(file, citygml_endings);
  if (documents.size() != 1 || documents.front().packed) return {};
  const city::Document& document = documents.front();
  const auto source = document.open();
  const MemberSplitter splitter(*source, document.name, {});
  const DocumentHead& head = splitter.head();
  const std::string text = city::read_start(document, searched_bytes);
  const bool is_utf16 = text.size() < 4 || text[0] == '\0' || text[1] == '\0';
  const std::size_t root = text.find(head.root_tag);
  if (is_utf16 || root == std::string::npos) return {};
  const std::string mark = find_member_mark(text, root + head.root_tag.size());
  if (mark.empty()) return {};
  city::FileCuts begun;
  begun.mark = mark;
  begun.tail = "</" + head.root_name + ">";
  begun.head_end = find_mark(text, mark, root + head.root_tag.size());
  const std::size_t head_end = static_cast<std::size_t>(begun.head_end);
  const auto members = count_members(text.substr(0, head_end) + begun.tail, document.name);
  if (!members) return {};
  begun.head_members = *members;
  const auto cuts = city::scan_cuts(file, std::move(begun), "appearanceMember");
  if (!cuts || std::filesystem::file_size(file) != cuts->size) return {};
  // A text in UTF-16 has other offsets in the file than as read: the file itself must begin so.
  const auto piece = city::find_piece(file, *cuts, 0, cuts->size);
  std::string own(head_end, '\0');
  if (!piece || city::open_piece(file, *piece)->read(own.data(), own.size()) != own.size() ||
      own != text.substr(0, head_end))
    return {};
  return cuts;
}

}  // namespace nightcity::citygml
