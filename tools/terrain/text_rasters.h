// Texts of heights in forms that GDAL does not read, put into one that it reads.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "tools/city/byte_source.h"

namespace nightcity::terrain {

/// Returns whether a file's name ends as those of tables or grids of heights in text do.
bool is_named_as_text_raster(std::string_view name);

/// Returns whether a text in such a file is to be put into another form: it is in UTF-16, begins
/// with the mark of UTF-8, or with comments behind '#'.
bool is_odd_text(std::string_view start);

/// Returns a source of the same text in UTF-8, without mark and comments at its beginning; of these
/// one that names the columns ("# y x z") becomes the headings. Words for unknown heights become
/// numbers that GDAL knows (height_words.h). What is no text passes through.
std::unique_ptr<city::ByteSource> straighten_text(std::unique_ptr<city::ByteSource> source);

}  // namespace nightcity::terrain
