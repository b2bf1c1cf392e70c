// The file of one part of a bake: the objects of its share of the inputs, ready for the city.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "formats/atomic_file.h"
#include "tools/bake/parts/share.h"
#include "tools/city/city_reader.h"

namespace nightcity::bake {

/// The receipt of a part says what the part was made from: one with the same receipt need not be
/// made again.
struct PartHead {
  std::string fingerprint;  // of recipe and inputs (fingerprint.h)
  std::string recipe;       // its path, absolute
  Share share;

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(fingerprint, recipe, share);
  }
};

/// A part file is a head and, for each piece of its share, its file, batches of objects and the
/// report of reading it. Each of these is a block with a checksum.
enum class BlockKind : std::uint32_t { head = 1, piece, objects, report, end };

/// The beginning of a piece.
struct PieceHead {
  std::uint64_t file = 0;  // its number in the city
  bool is_whole_file = false;
};

/// The file appears under its name when it is complete (AtomicFile). All functions throw Error.
class PartWriter {
 public:
  PartWriter(const std::filesystem::path& path, const PartHead& head);
  void write(BlockKind kind, const std::string& bytes);
  void commit();
  std::uint64_t size() const { return file_.size(); }
  /// Returns whether a write has failed: then an error is not the input's.
  bool has_failed() const { return has_failed_; }

 private:
  AtomicFile file_;
  bool has_failed_ = false;
};

class PartReader {
 public:
  /// Throws Error where the file cannot be read, is no part, or was cut off.
  explicit PartReader(const std::filesystem::path& path);

  const PartHead& head() const { return head_; }
  const std::string& name() const { return name_; }
  struct Block {
    BlockKind kind = BlockKind::end;
    std::string bytes;
  };
  /// Returns the next block; one of kind `end` behind the last. `skip_objects`: passes over blocks
  /// of objects. Throws Error where the file is damaged.
  Block next(bool skip_objects = false);
  /// Returns whether the file ends with the last block.
  bool is_complete() const;
  /// Goes back to the first block behind the head.
  void rewind();

 private:
  [[noreturn]] void fail_damaged() const;
  Block read_block(bool skip_objects);

  std::string name_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_ = 0, first_ = 0, at_ = 0;
  PartHead head_;
};

/// Returns the head of a complete part file; nothing where there is no file, or another one.
std::optional<PartHead> read_part_head(const std::filesystem::path& path);

}  // namespace nightcity::bake
