#include "formats/checksum.h"

#include <xxhash.h>

namespace nightcity {

std::uint64_t checksum(const void* bytes, std::size_t size) {
  return XXH64(bytes, size, 0);
}

}  // namespace nightcity
