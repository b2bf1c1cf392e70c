// Names of CRSs that PROJ's search finds, and those that it takes for others.
#pragma once

#include <string_view>

#include "tools/georeference/proj_axes.h"

namespace nightcity::georeference {

/// Returns whether `definition` is a name, and not that of `crs`, which PROJ made of it: to PROJ
/// any part of a name will do, so that "n/a" is Minna in Nigeria and "foo" Amersfoort. Capitals and
/// signs between words make no difference. The last part is a name ("LV95" of "CH1903+ / LV95"),
/// and so is any other that one CRS alone has.
bool is_another_name(PJ_CONTEXT* context, const PJ* crs, std::string_view definition);

}  // namespace nightcity::georeference
