// Finds where a CityGML file may be cut into pieces that are read one by one.
#pragma once

#include <filesystem>
#include <optional>

#include "tools/city/text_pieces.h"

namespace nightcity::citygml {

/// Returns the cuts of a file whose members stand one by one in its root element; nothing for
/// compressed files, for lists of members (gml:featureMembers), for UTF-16 and for files whose
/// colours stand beside their members. Throws Error where the file cannot be read.
std::optional<city::FileCuts> find_citygml_cuts(const std::filesystem::path& file);

}  // namespace nightcity::citygml
