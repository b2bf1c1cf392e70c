// One map in several files: nodes in one, and ways and relations that name them in others.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "formats/scratch_file.h"

namespace nightcity::osm {

/// What stands in place of the files of such a map, as long as it is kept.
using JoinedMaps = std::vector<std::shared_ptr<ScratchFile>>;

/// Where one of several files has ways or relations and no nodes, so that whoever reads it alone
/// finds no places, the first file is read as all of them together (`osmium merge`) from now on
/// and the others as empty; of several versions of an element the newest is there. Else, and where
/// the files are too large to be sorted in memory or hold an editor's ids, returns nothing: of
/// most maps the first element alone is looked at. Broken files are left to their readers.
JoinedMaps join_split_maps(std::span<const std::filesystem::path> files);

}  // namespace nightcity::osm
