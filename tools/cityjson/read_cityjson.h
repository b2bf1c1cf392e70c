// CityJSON 1.0, 1.1 and 2.0 (OGC 20-072r5) and CityJSONSeq, as city objects.
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::cityjson {

/// The endings of such files' names, in lower case and without .gz.
inline constexpr std::array<std::string_view, 2> cityjson_endings{".json", ".jsonl"};

/// Returns whether a document that begins with these bytes is CityJSON or CityJSONSeq.
bool begins_as_cityjson(std::string_view start);

/// Both read plain, gzipped and zipped files and throw Error, with file and line, where one is
/// broken, is no CityJSON, or refers to a version before 1.0. Coordinates are transformed, in the
/// order of the file.
city::CityHead read_cityjson_head(const std::filesystem::path& file,
                                  const city::ReadOptions& options = {});
city::ReadReport read_cityjson_staged(const std::filesystem::path& file,
                                      const city::ReadOptions& options,
                                      const city::ObjectStage& stage);

/// The same for one document. `on_disk`: it is a plain file of its name.
city::ReadReport read_cityjson_document(const city::Document& document, bool on_disk,
                                        const city::ReadOptions& options,
                                        const city::ObjectStage& stage);

}  // namespace nightcity::cityjson
