// The reader of CityGML documents that nightbake uses: members parsed in place, many at a time.
#pragma once

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::citygml {

/// Reads one document. Throws Error as read_citygml does.
city::ReadReport read_with_stream(const city::Document& document, const city::ReadOptions& options,
                                  const city::ObjectStage& stage);

}  // namespace nightcity::citygml
