// Lists the files of a city: a file stands for itself, a folder for the city files in it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::inputs {

/// Returns how the names of city files end, in lower case and without .gz: those of all city
/// formats in the table of file_format.h.
std::vector<std::string_view> city_endings();

/// Returns `path` itself unless it is a folder; then the files in it whose names end as
/// city_endings() says, also gzipped (.gml.gz), and its .zip archives, sorted by name so that every
/// file system gives the same order. Files there that are no city models (metadata, code lists,
/// maps) are passed over, each with a note on stderr. Folders inside are not entered: what lies
/// there (code lists, other themes) is for the user to name. Throws Error where the folder cannot
/// be read or holds no such file. A file named alone is not opened, so it need not exist.
std::vector<std::filesystem::path> city_files(const std::filesystem::path& path);

}  // namespace nightcity::inputs
