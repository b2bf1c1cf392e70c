// The entries of an archive, and of the archives in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/packing.h"

namespace nightcity::city {

/// An archive whose entries may be opened in any order, and by several threads.
class OpenArchive {
 public:
  virtual ~OpenArchive() = default;
  /// Returns the size that an entry is packed into; 0 where the archive does not say.
  virtual std::uint64_t packed_size(std::uint64_t index) = 0;
  /// Returns how many bytes it keeps in a file without a name.
  virtual std::uint64_t kept_bytes() const = 0;
  /// Opens an entry's bytes. `name`: for messages.
  virtual std::unique_ptr<ByteSource> open(std::uint64_t index, const std::string& name) = 0;
};

/// One file in an archive. Copies share the archive, which is open as long as one of them is there.
struct ArchiveEntry {
  std::string inside;  // its path in the archive: "data/a.gml", "tiles.zip/a.gml"
  std::shared_ptr<OpenArchive> archive;
  std::uint64_t index = 0;  // in `archive`

  std::uint64_t packed_size() const { return archive->packed_size(index); }
  /// Opens its bytes. `name`: for messages. Throws Error: encrypted, or of an unknown packing.
  std::unique_ptr<ByteSource> open(const std::string& name) const;
};

struct ArchiveListing {
  std::vector<ArchiveEntry> entries;
  /// Counts entries that are no files by what they are: "link", "device".
  std::map<std::string, std::size_t> left_out;
};

/// Returns how a file is packed; Packing::none where it is absent or no regular file.
Packing find_packing_of(const std::filesystem::path& file);
/// Returns whether the file at `path` that begins with `start` (packing_bytes of it) is an archive
/// (zip, tar, 7z, RAR), or a stream that holds one; false where it is a broken stream.
bool holds_archive(const std::string& path, std::string_view start);
/// The same of a file by itself; false where it is absent or no regular file.
bool is_archive_file(const std::filesystem::path& file);

/// Returns the files in the archive at `path`, in order; hidden ones and those that a Mac adds are
/// left out. In place of an archive stand the files in it: portals pack tiles that are packed
/// themselves. Archives deeper than that are entries, as is what is only named like one.
///
/// Archives in the archive are unpacked for that, as are all of a tar, 7z or RAR, into files
/// without a name in scratch_folder(), since their entries can be found in no other way. Those of
/// the archives that were listed last are kept, since every file is asked several times what it
/// holds. Throws Error where an archive is broken, or where it unpacks to more than UnpackedSize
/// allows, with all those in it.
std::shared_ptr<const ArchiveListing> list_archive(const std::filesystem::path& path);

}  // namespace nightcity::city
