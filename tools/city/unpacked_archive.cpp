#include "tools/city/unpacked_archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <zlib.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "formats/file_names.h"
#include "formats/scratch_file.h"
#include "tools/city/hidden_entry.h"

namespace nightcity::city {
namespace {

/// Says where an entry's bytes lie.
struct Piece {
  std::uint64_t offset = 0, size = 0;
  bool is_encrypted = false;
};

class UnpackedArchive : public OpenArchive, public std::enable_shared_from_this<UnpackedArchive> {
 public:
  UnpackedArchive() : bytes_(scratch_folder() / "archive") {}

  std::uint64_t packed_size(std::uint64_t index) override { return pieces_[index].size; }
  std::uint64_t kept_bytes() const override { return bytes_.size(); }
  std::unique_ptr<ByteSource> open(std::uint64_t index, const std::string& name) override;

  /// Adds the entry that the reader stands at, and returns its index. `sum` becomes the CRC-32 of
  /// its bytes, unless it is null.
  std::uint64_t add(LibarchiveReader& reader, bool is_encrypted, std::uint32_t* sum,
                    UnpackedSize& unpacked) {
    pieces_.push_back({bytes_.size(), 0, is_encrypted});
    if (is_encrypted) return pieces_.size() - 1;
    while (const std::size_t got = reader.read(block_.data(), block_.size())) {
      unpacked.add(got);
      bytes_.write(block_.data(), got);
      if (sum)
        *sum = static_cast<std::uint32_t>(
            crc32(*sum, reinterpret_cast<const Bytef*>(block_.data()), static_cast<uInt>(got)));
    }
    pieces_.back().size = bytes_.size() - pieces_.back().offset;
    return pieces_.size() - 1;
  }
  /// Ends the adding, before the first reading.
  void finish() {
    bytes_.flush();
    block_ = {};
  }
  void read(std::uint64_t offset, char* out, std::size_t size) { bytes_.read(offset, out, size); }

 private:
  ScratchFile bytes_;
  std::vector<Piece> pieces_;
  std::vector<char> block_ = std::vector<char>(std::size_t{1} << 16);
};

class EntrySource : public ByteSource {
 public:
  EntrySource(std::shared_ptr<UnpackedArchive> archive, const Piece& piece)
      : archive_(std::move(archive)), at_(piece.offset), end_(piece.offset + piece.size) {}

  std::size_t read(char* out, std::size_t size) override {
    const auto got = static_cast<std::size_t>(std::min<std::uint64_t>(size, end_ - at_));
    archive_->read(at_, out, got);
    at_ += got;
    return got;
  }

 private:
  std::shared_ptr<UnpackedArchive> archive_;
  std::uint64_t at_, end_;
};

std::unique_ptr<ByteSource> UnpackedArchive::open(std::uint64_t index, const std::string& name) {
  if (pieces_[index].is_encrypted)
    throw Error(name, "is encrypted with a password: unpack it first");
  return std::make_unique<EntrySource>(shared_from_this(), pieces_[index]);
}

// "./a.gml" is "a.gml": tar writes the first where it was told to pack the folder that it is in.
std::string to_plain_name(std::string name) {
  while (name.starts_with("./")) name.erase(0, name.find_first_not_of('/', 1));
  return name;
}

}  // namespace

ArchiveListing unpack_archive(LibarchiveReader& reader, UnpackedSize& unpacked,
                              const EntrySums& sums) {
  const auto archive = std::make_shared<UnpackedArchive>();
  ArchiveListing listing;
  std::unordered_map<std::string, std::size_t> places;  // of entries, by their names
  const auto add = [&](std::string name, std::uint64_t index) {
    const auto [place, is_new] = places.try_emplace(name, listing.entries.size());
    if (!is_new)
      listing.entries[place->second].index = index;
    else
      listing.entries.push_back({std::move(name), archive, index});
  };
  for (std::size_t number = 0; archive_entry* const entry = reader.find_next(); ++number) {
    std::string name = to_plain_name(reader.find_path(entry));
    const auto kind = archive_entry_filetype(entry);
    const std::string target = to_plain_name(reader.find_link(entry));
    if (kind == AE_IFDIR || name.empty() || name.ends_with('/') || is_hidden_entry(name)) continue;
    if (!target.empty() && archive_entry_size(entry) == 0) {
      const auto place = places.find(target);
      if (place == places.end())
        ++listing.left_out["link"];
      else
        add(std::move(name), listing.entries[place->second].index);
    } else if (kind == AE_IFREG || kind == 0) {
      const bool is_encrypted = archive_entry_is_encrypted(entry) != 0;
      const bool has_sum = !is_encrypted && number < sums.size() && sums[number];
      std::uint32_t sum = 0;
      add(std::move(name), archive->add(reader, is_encrypted, has_sum ? &sum : nullptr, unpacked));
      if (has_sum && sums[number] != sum) reader.fail("an entry's sum is wrong");
    } else {
      ++listing.left_out[kind == AE_IFLNK ? "link" : "device"];
    }
  }
  reader.require_end();
  archive->finish();
  return listing;
}

}  // namespace nightcity::city
