// Parts of a bake, put together again: the objects of all parts, in the order of the inputs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/bake/city/city_consumer.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/city/ground_heights.h"
#include "tools/bake/parts/part_file.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/city_report.h"

namespace nightcity::bake {

/// Returns the files of a whole set of parts in order. `named`: part files, and folders that hold
/// some, in any order. Where folders hold several sets (of 3 and of 64 parts, say), the first that
/// is whole and has this fingerprint counts. Throws Error that says which parts are missing or made
/// from other inputs.
std::vector<std::filesystem::path> find_part_set(const std::vector<std::filesystem::path>& named,
                                                 const std::string& fingerprint);

/// Returns the recipe that the parts name, which must be one. Throws Error where `named` holds no
/// part.
std::filesystem::path find_recipe(const std::vector<std::filesystem::path>& named);

/// Passes the objects of all parts to the consumers, as read_prepared_objects does with those of
/// the files. A file that could not be read in pieces is read here. Throws Error where a part is
/// damaged.
CityReport read_parts(const std::vector<std::filesystem::path>& parts, const CityInputs& inputs,
                      CityFrames& frames, const GroundHeights* heights,
                      std::span<CityConsumer* const> consumers, const ProgressSink& progress);

}  // namespace nightcity::bake
