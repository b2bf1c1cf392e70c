// libcitygml's object tree into ours.
#pragma once

#include <citygml/cityobject.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/city/merge_parts.h"

namespace nightcity {

struct LibcitygmlObject {
  city::RawObject raw;
  std::size_t polygons_seen = 0;               // distinct ones
  std::map<std::string, std::size_t> skipped;  // what was seen and not taken
};

/// `themes`: of the model's appearances, for X3DMaterial colours; the first that gives a polygon one wins.
LibcitygmlObject convert(const citygml::CityObject& root, const std::vector<std::string>& themes);

}  // namespace nightcity
