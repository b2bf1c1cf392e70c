#include "tools/cityjson/document_reader.h"

#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "formats/error.h"
#include "tools/cityjson/document_index.h"
#include "tools/cityjson/document_text.h"
#include "tools/cityjson/feature_reader.h"
#include "tools/cityjson/object_groups.h"
#include "tools/cityjson/part_parser.h"
#include "tools/cityjson/sample.h"
#include "tools/in_order.h"

namespace nightcity::cityjson {
namespace {

constexpr std::size_t batch_bytes = std::size_t{1} << 18;
constexpr std::size_t vertex_block_bytes = std::size_t{1} << 20;

// A document, known from its index and its small parts.
class Document {
 public:
  Document(std::string_view text, const std::string& name, std::size_t max_part)
      : text_(text), name_(name), max_part_(max_part), index_(index_document(text, name)) {
    for (const auto& [key, value] : index_.members) {
      if (key == "vertices") continue;
      if (key == "CityObjects") throw Error(where(value), "\"CityObjects\" is no object");
      parsers_.emplace_back(text, name, max_part);
      const std::vector<dom::element> parsed = parsers_.back().parse(std::span(&value, 1));
      shared_.read(
          key, parsed.front(), [&, text = value] { return where(text); }, skipped_);
    }
    shared_.require_type(name);
  }

  const std::vector<ObjectText>& objects() const { return index_.objects; }
  const SharedParts& shared() const { return shared_; }
  city::SkipCounter& skipped() { return skipped_; }
  void find_pictures(const city::ReadOptions& options) {
    shared_.materials.find_pictures(name_, options, skipped_);
  }

  // Calls `take(vertices, number of the first)` until it returns false.
  template <class Take>
  void read_vertex_blocks(unsigned threads, const Take& take) const {
    std::string_view rest = vertex_text();
    std::size_t count = 0;
    bool wanted = true;
    in_order(
        threads,
        [&]() -> std::optional<std::string_view> {
          const std::size_t begin = rest.find_first_not_of(" \t\r\n,");
          if (begin == std::string_view::npos || !wanted) return {};
          std::size_t end = rest.find(']', std::min(begin + vertex_block_bytes, rest.size()));
          end = end == std::string_view::npos ? rest.size() : end + 1;
          const std::string_view block = rest.substr(begin, end - begin);
          rest.remove_prefix(end);
          return block;
        },
        [&](std::string_view block) {
          PartParser parser(text_, name_, max_part_);
          return read_vertices(parser.parse_inside(std::span(&block, 1)), shared_.transform);
        },
        [&](std::vector<glm::dvec3>&& block) {
          if (wanted) wanted = take(block, count);
          count += block.size();
        });
  }

 private:
  std::string where(std::string_view value) const {
    const auto place = static_cast<std::size_t>(value.data() - text_.data());
    return name_ + ":" + std::to_string(line_of(text_, place));
  }

  // The inside of the array.
  std::string_view vertex_text() const {
    const auto at = index_.members.find("vertices");
    if (at == index_.members.end()) return {};
    std::string_view text = at->second;
    if (!text.starts_with('[')) throw Error(where(text), "\"vertices\" is no array");
    text.remove_prefix(1);
    text.remove_suffix(1);
    return text;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t max_part_;
  DocumentIndex index_;
  std::deque<PartParser> parsers_;  // hold what shared_ refers to
  SharedParts shared_;
  city::SkipCounter skipped_;
};

class DocumentReader {
 public:
  DocumentReader(std::string_view text, const std::string& name, const city::ReadOptions& options,
                 const city::ObjectStage& stage)
      : text_(text),
        name_(name),
        options_(options),
        stage_(stage),
        document_(text, name, options.max_member_bytes()) {}

  city::ReadReport read() {
    document_.find_pictures(options_);
    report_.version = document_.shared().version;
    report_.srs_name = document_.shared().srs_name;
    document_.shared().require_srs_name(options_.srs_name, name_);
    list_nodes();
    groups_ = group_objects(nodes_, document_.skipped());
    document_.read_vertex_blocks(options_.threads,
                                 [&](std::span<const glm::dvec3> block, std::size_t) {
                                   vertices_.insert(vertices_.end(), block.begin(), block.end());
                                   all_usable_ = all_usable_ && are_usable(block);
                                   return true;
                                 });
    std::size_t next = 0;
    in_order(
        options_.threads, [&] { return next_groups(next); },
        [&](const Groups& groups) { return read_groups(groups); },
        [&](Batch&& batch) { batch.take_into(report_); });
    document_.skipped().merge_into(report_.skipped);
    return std::move(report_);
  }

 private:
  struct Groups {
    std::size_t first, end;
  };

  // Returns a text of the file without its escapes. Nearly all have none.
  std::string_view unescape(std::string_view raw) {
    if (raw.find('\\') == std::string_view::npos) return raw;
    const std::string quoted = "\"" + std::string(raw) + "\"";
    const std::string_view part = quoted;
    PartParser parser(part, name_, options_.max_member_bytes());
    return unescaped_.emplace_back(to_text(parser.parse(std::span(&part, 1)).front()));
  }

  void list_nodes() {
    PartParser parser(text_, name_, options_.max_member_bytes());
    nodes_.reserve(document_.objects().size());
    for (const ObjectText& object : document_.objects()) {
      ObjectNode& node = nodes_.emplace_back();
      node.id = unescape(object.id);
      node.what = find_object_class(object.type);
      node.parent = unescape(object.parent);
      if (object.children.empty()) continue;
      dom::array children;
      const std::vector<dom::element> parsed = parser.parse(std::span(&object.children, 1));
      if (parsed.front().get(children) != simdjson::SUCCESS) continue;
      keep_children(children, object.children, node.children);
    }
  }

  // Keeps the names of children where they live longer than their parser: in the file's `text`,
  // where they stand in this order, unless it has escapes.
  void keep_children(const dom::array& names, std::string_view text,
                     std::vector<std::string_view>& children) {
    const bool has_escapes = text.find('\\') != std::string_view::npos;
    std::size_t from = 0;
    for (const dom::element& name : names) {
      std::string_view id;
      if (name.get(id) != simdjson::SUCCESS) continue;
      const std::size_t at = has_escapes ? std::string_view::npos : text.find(id, from);
      if (at == std::string_view::npos) {
        children.push_back(unescaped_.emplace_back(id));
        continue;
      }
      children.push_back(text.substr(at, id.size()));
      from = at + id.size();
    }
  }

  std::optional<Groups> next_groups(std::size_t& next) const {
    if (next >= groups_.size()) return {};
    Groups groups{next, next};
    const std::size_t enough = options_.passes_one_by_one() ? 1 : batch_bytes;
    for (std::size_t bytes = 0; groups.end < groups_.size() && bytes < enough; ++groups.end)
      for (const std::uint32_t n : groups_.group(groups.end))
        bytes += document_.objects()[n].value.size();
    next = groups.end;
    return groups;
  }

  Batch read_groups(const Groups& groups) const {
    Batch batch;
    PartParser parser(text_, name_, options_.max_member_bytes());
    const GeometrySources sources{vertices_, all_usable_, &document_.shared(),
                                  &document_.shared().materials};
    std::vector<std::string_view> parts;
    std::vector<GroupMember> group;
    for (std::size_t i = groups.first; i < groups.end; ++i) {
      parts.clear();
      group.clear();
      for (const std::uint32_t n : groups_.group(i)) parts.push_back(document_.objects()[n].value);
      const std::vector<dom::element> parsed = parser.parse(parts);
      auto element = parsed.begin();
      bool usable = true;
      for (const std::uint32_t n : groups_.group(i)) {
        dom::object object;
        if ((*element).get(object) == simdjson::SUCCESS)
          group.push_back({nodes_[n].id, nodes_[n].what, object});
        else
          usable &= !group.empty();
        ++element;
      }
      if (usable && !group.empty())
        batch.read(group, sources, options_);
      else
        batch.skipped.add("city object that is no object");
    }
    batch.hand_over(stage_);
    return batch;
  }

  std::string_view text_;
  const std::string& name_;
  const city::ReadOptions& options_;
  const city::ObjectStage& stage_;
  Document document_;
  std::vector<ObjectNode> nodes_;
  std::deque<std::string> unescaped_;
  ObjectGroups groups_;
  std::vector<glm::dvec3> vertices_;
  bool all_usable_ = true;
  city::ReadReport report_;
};

}  // namespace

city::ReadReport read_document(std::string_view text, const std::string& name,
                               const city::ReadOptions& options, const city::ObjectStage& stage) {
  return DocumentReader(text, name, options, stage).read();
}

city::CityHead read_document_head(std::string_view text, const std::string& name,
                                  const city::ReadOptions& options) {
  Document document(text, name, options.max_member_bytes());
  Sample sample;
  PartParser parser(text, name, options.max_member_bytes());
  for (const ObjectText& object : document.objects()) {
    if (sample.is_full()) break;
    sample.add_object(parser.parse(std::span(&object.value, 1)).front());
  }
  document.read_vertex_blocks(1, [&](std::span<const glm::dvec3> block, std::size_t first) {
    sample.take_vertices(block, first);
    return !sample.is_complete();
  });
  city::CityHead head;
  head.version = document.shared().version;
  head.srs_name = document.shared().srs_name;
  sample.move_to(head);
  return head;
}

}  // namespace nightcity::cityjson
