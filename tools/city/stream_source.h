// Streams of gzip, bzip2, xz and others, wherever their bytes come from.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/city/byte_source.h"
#include "tools/city/packing.h"

namespace nightcity::city {

/// Returns a source of what a stream, of `packed` bytes, holds. `name` is for messages. It, or its
/// read, throws Error where the stream is broken or unpacks to more than its size allows.
std::unique_ptr<ByteSource> unpack_stream(Packing packing, std::unique_ptr<ByteSource> source,
                                          const std::string& name, std::uint64_t packed);

}  // namespace nightcity::city
