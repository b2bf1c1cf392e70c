// Converts libcitygml's object tree into our model.
#pragma once

#include <citygml/cityobject.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/city/merge_parts.h"

namespace nightcity::citygml {

struct LibcitygmlObject {
  city::RawObject raw;
  std::size_t polygons_seen = 0;               // distinct ones
  std::map<std::string, std::size_t> skipped;  // what was seen and not used, and how often
};

/// `themes`: those of the model's appearances; the first with an X3DMaterial for a polygon gives
/// its colour.
LibcitygmlObject convert(const ::citygml::CityObject& root, const std::vector<std::string>& themes);

}  // namespace nightcity::citygml
