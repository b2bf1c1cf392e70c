// Words that stand for heights that are not known, in texts of heights.
#pragma once

#include <memory>
#include <string_view>

#include "tools/city/byte_source.h"

namespace nightcity::terrain {

/// Returns whether a text whose first bytes these are may be a grid or a table of heights: it holds
/// no bytes that texts do not have.
bool begins_as_text(std::string_view start);

/// Returns a source of the same grid or table with a number for each word among its numbers ("NA",
/// "null", "*", "---") that stands for no height. GDAL takes such a word for a height of 0, and
/// passes over rows that begin with a letter, so that all rows behind them move. Lines before the
/// first number stay.
std::unique_ptr<city::ByteSource> replace_height_words(std::unique_ptr<city::ByteSource> source);

/// Returns whether that changes anything.
bool has_height_words(std::unique_ptr<city::ByteSource> source);

}  // namespace nightcity::terrain
