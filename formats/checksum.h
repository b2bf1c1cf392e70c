// The checksum of our files.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nightcity {

/// Returns XXH64 with seed 0 (Collet, xxHash).
std::uint64_t checksum(const void* bytes, std::size_t size);

}  // namespace nightcity
