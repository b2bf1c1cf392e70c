// Names files that are not read here in the words of the people who have them, with the remedy.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::city {

/// Returns the name, without prefix, of an XML document's root element; "" where `start` ends
/// before it or is no XML.
std::string_view find_root_name(std::string_view start);

/// Returns what a file is that no reader takes, and what helps ("is a tar archive: unpack it
/// first"); "" where its first bytes say nothing, nor the ending of its name. `bytes`: of the
/// content, unpacked, at least 512 where the file has them. `name`: of the file, in lower case.
std::string explain_foreign(std::string_view bytes, std::string_view name);

/// Returns the same where no city model was asked for but a table, a raster or photometry: a remedy
/// that leads to a model is left out ("is KML").
std::string name_foreign(std::string_view bytes, std::string_view name);

}  // namespace nightcity::city
