// Wavefront OBJ (Appendix B1 of the Advanced Visualizer manual) as city objects.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::obj {

/// The endings of such files' names, in lower case and without .gz.
inline constexpr std::array<std::string_view, 1> obj_endings{".obj"};

/// Returns whether a document that begins with these bytes is an OBJ.
bool begins_as_obj(std::string_view start);

/// Both read plain, gzipped and zipped files and throw Error, with file and line, where one is
/// broken. Of an archive's documents whose names differ in a level of detail alone the best is read
/// (level_in_name.h). The file names no CRS; its coordinates become E, N, H by ReadOptions::mesh.
/// Objects or groups are buildings, unless their names, or those of all their materials, say
/// otherwise; of a file that names no parts, faces that hang together are one. Colours come from
/// the libraries beside the file (Kd). Textures, colours of vertices, lines, points and surfaces of
/// parameters are skipped and counted. Memory holds the vertices and one object, of a file that
/// names no parts all faces.
city::CityHead read_obj_head(const std::filesystem::path& file,
                             const city::ReadOptions& options = {});
city::ReadReport read_obj_staged(const std::filesystem::path& file,
                                 const city::ReadOptions& options, const city::ObjectStage& stage);

/// The same for one document.
city::ReadReport read_obj_document(const city::Document& document, const city::ReadOptions& options,
                                   const city::ObjectStage& stage);

}  // namespace nightcity::obj
