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

/// Returns `path` itself unless it is a folder; then the files in it and in the folders inside
/// whose names end as city_endings() says, also in streams (.gml.gz), and of archives (.zip, .7z),
/// sorted by path so that every file system gives the same order. Links to folders are not
/// followed, and names that begin with a dot are passed over. Files that are no city models
/// (metadata, code lists, maps) are passed over too, with a note on stderr for each folder and
/// kind. Throws Error where a folder cannot be read or there is no such file. A file named alone is
/// not opened, so it need not exist.
std::vector<std::filesystem::path> city_files(const std::filesystem::path& path);

}  // namespace nightcity::inputs
