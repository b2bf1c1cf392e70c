// Tables in archives and streams (gzip, xz, ...), in their whole in memory.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/byte_source.h"

namespace nightcity::inventory {

/// A file as GDAL is to see it.
struct MemoryFile {
  std::string name, bytes;
};

/// Returns a table in a stream or an archive, and of a Shapefile the files that belong to it behind
/// the first, whatever folder of the archive they lie in; none where the file is not packed. Text
/// in UTF-16 is in UTF-8. Throws Error: an archive without a table, with several, broken,
/// encrypted, or which unpacks to more than memory is meant for (SECURITY.md).
std::vector<MemoryFile> unpack_table(const std::filesystem::path& file);

/// Returns all of a document. Throws Error where there is more than 1 GB: `remedy` says what helps.
std::string read_whole(const city::Document& document, std::string_view remedy);

}  // namespace nightcity::inventory
