// Which files a city is made of: a file stands for itself, a folder for the CityGML files in it.
#pragma once

#include <filesystem>
#include <vector>

namespace nightcity {

/// `path` itself unless it is a folder; then its .gml, .xml and .citygml files, also gzipped (.gml.gz), and
/// its .zip archives, by name, so that every file system gives the same order. Folders inside are not
/// entered: what lies there (code lists, other themes) is for the user to name. Throws Error where the folder
/// cannot be read or holds no such file. A file is not opened, so it need not exist.
std::vector<std::filesystem::path> city_files(const std::filesystem::path& path);

}  // namespace nightcity
