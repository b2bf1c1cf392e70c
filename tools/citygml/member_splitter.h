// Cuts a CityGML document into its members (cityObjectMember, featureMember, ...) by one scan for
// tags, without loading it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {

/// The part of a document before its first member.
struct DocumentHead {
  std::string root_tag;   // "<core:CityModel xmlns:..." as written, with its angle brackets
  std::string root_name;  // "core:CityModel"
  std::string version;    // the newest CityGML version among its namespaces: "2.0"; "" = none
  bool latin1 = false;    // declared ISO-8859-1 or windows-1252; else UTF-8
};

/// The bytes of whole members, writable so that an in-place parser may use them.
struct MemberBatch {
  struct Member {
    std::size_t begin, size;  // of the element with its tags, in `bytes`
    std::size_t line;         // of its first byte, from 1
    std::string name;         // local name of the element: "cityObjectMember", "boundedBy", ...
    bool continued = false;   // a later piece of the member before it
  };
  std::unique_ptr<char[]> bytes;
  std::vector<Member> members;
  std::size_t first_member = 0;  // index in the document of members[0]; each piece counts

  std::string_view text(const Member& member) const {
    return {bytes.get() + member.begin, member.size};
  }
};

class MemberSplitter {
 public:
  struct Limits {
    std::size_t batch_bytes = std::size_t{1} << 20;
    /// A longer member is cut between the triangles of its TIN, each piece wrapped in the tags open
    /// at the cut, so that terrain of any size passes in bounded memory.
    std::size_t piece_bytes = std::size_t{4} << 20;
    std::size_t member_bytes = std::size_t{256} << 20;  // longer ones are refused
    std::size_t depth = 200;                            // deeper nesting is refused
    /// Follow every tag. Otherwise the inside of a member is passed on unchecked and may be
    /// ill-formed or too deep.
    bool every_tag = false;
    std::size_t lines_left_out = 0;  // between the root's start tag and the text behind it
  };

  /// Reads up to the root's start tag. Throws Error: not XML, DOCTYPE, UTF-16, truncated.
  MemberSplitter(city::ByteSource& source, std::string name, const Limits& limits);

  const DocumentHead& head() const { return head_; }
  /// Fills `batch` with the next members, in order; false behind the last. Throws Error where tags
  /// do not nest or the file ends early.
  bool next(MemberBatch& batch);

 private:
  /// Begin and end of a start tag in the scanner's window.
  using Range = std::pair<std::size_t, std::size_t>;

  void read_head();
  void refuse_second_document();
  bool scan_tag(MemberBatch& batch);
  bool passes_text(const MemberBatch& batch);
  void close_tag(const Tag& tag);
  void pass_on(MemberBatch& batch, std::size_t end);
  void pass_on_piece(MemberBatch& batch);

  TagScanner scanner_;
  Limits limits_;
  DocumentHead head_;
  std::vector<Range> open_;  // start tags open inside the current member
  std::string list_;         // name of the current member list; "" = members stand in the root
  std::size_t member_line_ = 1;
  std::size_t cut_ = 0;  // where the current member is to be cut; 0 = not
  std::size_t delivered_ = 0;
  bool continued_ = false;  // the current member has had a piece cut off
  bool finished_ = false;
};

/// Returns the limits that a reader's options ask for.
MemberSplitter::Limits limits_of(const city::ReadOptions& options);

}  // namespace nightcity::citygml
