// CityGML documents read by libcitygml, as a second opinion.
#pragma once

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::citygml {

/// Reads one document, on one thread. Throws Error as read_citygml does.
city::ReadReport read_with_libcitygml(const city::Document& document,
                                      const city::ReadOptions& options,
                                      const city::ObjectSink& sink);

}  // namespace nightcity::citygml
