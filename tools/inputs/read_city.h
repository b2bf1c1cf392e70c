// City files of any format in the table of file_format.h.
#pragma once

#include <filesystem>

#include "tools/city/city_reader.h"

namespace nightcity::inputs {

/// All three throw Error where the file is no city file, and as its reader does.
city::CityHead read_city_head(const std::filesystem::path& file,
                              const city::ReadOptions& options = {});
city::ReadReport read_city(const std::filesystem::path& file, const city::ReadOptions& options,
                           const city::ObjectSink& sink);
city::ReadReport read_city_staged(const std::filesystem::path& file,
                                  const city::ReadOptions& options, const city::ObjectStage& stage);

}  // namespace nightcity::inputs
