// Places tables of lamps that name no CRS beside the other files of a city.
#pragma once

#include <vector>

#include "tools/survey/survey.h"

namespace nightcity::survey {

/// The words of a table's `what` that place_tables() replaces.
constexpr const char* assumed_degrees = "longitude and latitude are assumed";

/// Reads the lamps of the table by its `inventory`. Throws Error as read_inventory does.
void read_lamps(SurveyedFile& table);

/// Gives each table whose places are no degrees the first CRS of those of the models, those of the
/// rasters, and those usual at their place by which it lies beside a file that has one. A table
/// that none of them fits is then without a use.
void place_tables(std::vector<SurveyedFile>& files);

}  // namespace nightcity::survey
