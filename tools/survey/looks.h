// Looks at a file as one of the kinds that make a city.
#pragma once

#include <filesystem>
#include <string>

#include "tools/survey/survey.h"

namespace nightcity::survey {

/// Each fills in what the file is, by its path. They throw Error where it is no such file, or
/// broken; a table of something else than lamps has no use then. `format`: its name for messages.
void look_at_city(SurveyedFile& file, const std::string& format);
void look_at_map(SurveyedFile& file);
void look_at_table(SurveyedFile& file);
void look_at_raster(SurveyedFile& file);
void look_at_luminaire(SurveyedFile& file, const std::string& format);

}  // namespace nightcity::survey
