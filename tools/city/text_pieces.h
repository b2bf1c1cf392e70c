// Pieces of a text file that are read one by one, on different machines if need be: a file of
// members, such as CityGML, can be cut wherever a member begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/city/byte_source.h"

namespace nightcity::city {

/// A piece that holds whole members. It is read as a document of its own: the file's head, the
/// bytes from `begin` to `end`, then `tail`.
struct TextPiece {
  std::uint64_t head_end = 0, begin = 0, end = 0;
  std::size_t head_members = 0;    // elements in the head's root: those of the first piece
  std::string tail;                // closes what the head opens; "" for the file's own end
  std::size_t lines_left_out = 0;  // between head and `begin`

  bool is_first() const { return begin == head_end; }
};

/// The places at which a file may be cut.
struct FileCuts {
  std::uint64_t size = 0;                // of the file
  std::uint64_t head_end = 0;            // where the first member begins
  std::uint64_t head_members = 0;        // elements in the root before it
  std::string mark;                      // with which a member begins: "<core:cityObjectMember"
  std::string tail;                      // "</core:CityModel>"
  std::vector<std::uint64_t> line_ends;  // number of them before each block of `block` bytes

  static constexpr std::uint64_t block = std::uint64_t{4} << 20;

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(size, head_end, head_members, mark, tail, line_ends);
  }
};

/// Completes the cuts of a file, of which size and line ends are not known yet. Returns nothing
/// where `forbidden` stands anywhere in it. Throws Error where it cannot be read.
std::optional<FileCuts> scan_cuts(const std::filesystem::path& file, FileCuts cuts,
                                  const std::string& forbidden);

/// Returns the piece with the members that begin in bytes [begin, end) of the file; nothing where
/// none does. Pieces of neighbouring ranges meet without a gap. The mark may stand in a comment
/// too: then the piece before it ends inside that comment, and its reader refuses it.
std::optional<TextPiece> find_piece(const std::filesystem::path& file, const FileCuts& cuts,
                                    std::uint64_t begin, std::uint64_t end);

/// Opens a piece as a document of its own. Throws Error where the file cannot be read.
std::unique_ptr<ByteSource> open_piece(const std::filesystem::path& file, const TextPiece& piece);

}  // namespace nightcity::city
