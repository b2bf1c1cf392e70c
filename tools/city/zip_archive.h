// The entries of a zip archive, and of the archives in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/byte_source.h"

namespace nightcity::city {

/// The first bytes of a zip archive that holds something.
constexpr std::string_view zip_mark = "PK\x03\x04";

/// Returns whether a file begins so; false where it is absent or no regular file.
bool is_zip(const std::filesystem::path& file);

class ZipArchive;

/// One file in an archive. Copies share the archive, which is open as long as one of them is there.
struct ZipEntry {
  std::string inside;  // its path in the archive: "data/a.gml", "tiles.zip/a.gml"
  std::shared_ptr<ZipArchive> archive;
  std::uint64_t index = 0;  // in `archive`

  /// Returns the size that it is packed into; 0 where the archive does not say.
  std::uint64_t packed_size() const;
  /// Opens its bytes. `name`: for messages. Throws Error: encrypted, or of an unknown packing.
  std::unique_ptr<ByteSource> open(const std::string& name) const;
};

/// Returns the files in the archive at `path`, in order; hidden ones and those that a Mac adds are
/// left out. In place of an archive stand the files in it: portals pack tiles that are packed
/// themselves. Archives deeper than that are entries, as is what is only named like one.
///
/// Archives in the archive are unpacked for that, into files without a name in scratch_folder(),
/// as their entries can be found in no other way. Those of the archive that was listed last are
/// kept, since every file is asked several times what it holds. Throws Error where an archive is
/// broken, or where those in it unpack to more than UnpackedSize allows all of them together.
std::vector<ZipEntry> list_zip_entries(const std::string& path);

}  // namespace nightcity::city
