// The reader of CityGML documents that nightbake uses: members parsed in place, many at a time.
#pragma once

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity {

/// Reads one document. Throws Error as read_citygml does.
ReadReport read_with_stream(const city::Document& document, const ReadOptions& options,
                            const ObjectStage& stage);

}  // namespace nightcity
