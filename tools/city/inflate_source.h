// A gzip stream that is itself unpacked from an archive.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/city/byte_source.h"

namespace nightcity::city {

/// Returns a source of what a gzip stream, of `packed` bytes, holds. `name` is for messages. Its
/// read throws Error where the stream is broken or unpacks to more than its size allows.
std::unique_ptr<ByteSource> inflate_stream(std::unique_ptr<ByteSource> source, std::string name,
                                           std::uint64_t packed);

}  // namespace nightcity::city
