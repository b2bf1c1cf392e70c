// City files of any format in the table of file_format.h.
#pragma once

#include <filesystem>
#include <optional>

#include "tools/city/city_reader.h"

namespace nightcity::inputs {

/// All functions throw Error where the file is no city file, and as its reader does.
city::CityHead read_city_head(const std::filesystem::path& file,
                              const city::ReadOptions& options = {});
city::ReadReport read_city(const std::filesystem::path& file, const city::ReadOptions& options,
                           const city::ObjectSink& sink);
city::ReadReport read_city_staged(const std::filesystem::path& file,
                                  const city::ReadOptions& options, const city::ObjectStage& stage);
/// Returns how the file may be cut into pieces; nothing where it has to be read whole.
std::optional<city::FileCuts> find_cuts(const std::filesystem::path& file);

}  // namespace nightcity::inputs
