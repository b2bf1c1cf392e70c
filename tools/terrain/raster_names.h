// Files of elevation models, by their names.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace nightcity::terrain {

/// Returns whether a file's name ends as those of rasters of heights do, text among them.
bool is_named_as_raster(std::string_view name);

/// Returns whether a file's name ends as those of text do, which may be a table of heights, and may
/// be anything else.
bool is_named_as_text(std::string_view name);

/// Returns whether a file's name ends as those that GDAL reads beside a raster of the same name do:
/// its place, its CRS, its form, its pixels or its mask.
bool is_named_as_companion(std::string_view name);

/// Returns whether a raster's name says that it tells something else of an elevation model: how
/// good its heights are, where water is, which way it slopes. Copernicus, ASTER and ALOS deliver
/// such beside the heights.
bool is_about_heights(std::string_view name);

/// Returns `path` itself unless it is a folder; then the files in it and in the folders inside
/// whose names end as those of rasters, of these in streams (.gz), and of archives, sorted by path.
/// Texts, names that begin with a dot, and what is_about_heights are passed over, the last with a
/// note on stderr. Throws Error where a folder cannot be read or holds none.
std::vector<std::filesystem::path> list_raster_files(const std::filesystem::path& path);

}  // namespace nightcity::terrain
