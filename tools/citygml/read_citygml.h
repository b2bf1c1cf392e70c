// CityGML 1.0, 2.0 and 3.0 files, plain, gzipped or in a zip archive.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "tools/city/city_reader.h"

namespace nightcity::citygml {

/// The endings of CityGML files' names, in lower case and without .gz. Other files in folders and
/// archives are not read.
constexpr std::array<std::string_view, 3> citygml_endings{".gml", ".xml", ".citygml"};

/// Streams the file's objects into `sink`, in file order, in memory that does not grow with the
/// file. Throws Error: missing, empty, truncated, not XML, not CityGML, DOCTYPE.
city::ReadReport read_citygml(const std::filesystem::path& file, const city::ReadOptions& options,
                              const city::ObjectSink& sink);

/// The same through a stage of work.
city::ReadReport read_citygml_staged(const std::filesystem::path& file,
                                     const city::ReadOptions& options,
                                     const city::ObjectStage& stage);

}  // namespace nightcity::citygml
