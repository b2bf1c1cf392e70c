// The reader of CityGML documents that nightbake uses: members parsed in place, many at a time.
#pragma once

#include <span>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::citygml {

/// Reads one document. Links lead into the neighbours of the options; `siblings`, the documents of
/// its archive, are found there too. Throws Error as read_citygml does.
city::ReadReport read_with_stream(const city::Document& document,
                                  std::span<const city::Document> siblings,
                                  const city::ReadOptions& options, const city::ObjectStage& stage);

}  // namespace nightcity::citygml
