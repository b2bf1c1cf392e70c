// Archives, which may hold a city model, a map, heights and a table of lamps at once.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/inputs/file_format.h"
#include "tools/survey/survey.h"

namespace nightcity::survey {

/// Returns the file once for each of several uses that its contents have: each key of a recipe
/// reads what belongs to it. Empty for a file that is no archive, or has fewer than two uses.
std::vector<SurveyedFile> find_archive_uses(const std::filesystem::path& path);

/// Adds to `what` what else an archive holds that a recipe could name, and that no look has taken.
void tell_unread(SurveyedFile& file, inputs::FileKind read);

bool is_archive_of_rasters(const std::filesystem::path& path);

}  // namespace nightcity::survey
