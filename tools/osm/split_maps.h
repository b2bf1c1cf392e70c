// One map in several files: nodes in one, and ways and relations that name them in others.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "formats/scratch_file.h"

namespace nightcity::osm {

/// These files stand in place of those of such a map, as long as they are kept.
using JoinedMaps = std::vector<std::shared_ptr<ScratchFile>>;

/// Joins the files where one of them has ways or relations and no nodes, so that whoever reads it
/// alone finds no places: from now on the first is read as all of them together (`osmium merge`),
/// with the newest version of each element, and the others as empty. Returns nothing for other
/// files, most of which it looks at no further than their first element, and where they are too
/// large to be sorted in memory or hold an editor's ids. Broken files are left to their readers.
JoinedMaps join_split_maps(std::span<const std::filesystem::path> files);

}  // namespace nightcity::osm
