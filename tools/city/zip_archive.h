// Zip archives, whose entries are read where they lie.
#pragma once

#include <memory>
#include <string>

#include "formats/scratch_file.h"
#include "tools/city/archive_entries.h"

namespace nightcity::city {

/// Returns what the zip archive at `path` holds, without looking into archives in it. `unpacked`:
/// the file that it lies in, where this has no name. Throws Error where it is broken.
ArchiveListing list_zip(const std::string& path, const std::string& name,
                        std::shared_ptr<ScratchFile> unpacked);

}  // namespace nightcity::city
