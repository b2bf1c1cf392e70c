// Archives whose entries can only be read one after the other: tar, 7z and RAR.
#pragma once

#include <memory>
#include <string>

#include "tools/city/archive_entries.h"
#include "tools/city/libarchive_reader.h"
#include "tools/city/rar_sums.h"
#include "tools/city/unpacked_size.h"

namespace nightcity::city {

/// Unpacks all of an archive into one file without a name, and returns what it holds, without
/// looking into archives in it. Names are names alone: nothing is written under them. A later entry
/// replaces an earlier one of the same path, as tar has it; a hard link is the file that it names.
/// `sums` are those that the archive says of its entries, where libarchive does not compare them.
/// Throws Error where the archive is broken, or unpacks to more than `unpacked` allows. An entry
/// that is encrypted says so when it is opened.
ArchiveListing unpack_archive(LibarchiveReader& reader, UnpackedSize& unpacked,
                              const EntrySums& sums = {});

}  // namespace nightcity::city
