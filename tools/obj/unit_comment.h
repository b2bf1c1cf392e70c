// Units of length that programs write into the comments of a Wavefront OBJ.
#pragma once

#include <string>

#include "tools/city/byte_source.h"

namespace nightcity::obj {

/// Returns the unit that a comment near the beginning of the file names ("# File units = inches",
/// as SketchUp writes, "# Units: mm"); "" where none does.
std::string find_unit_comment(const city::Document& document);

}  // namespace nightcity::obj
