// Corrects the checksums of a light file, so that tests can break the content that they protect.
#pragma once

#include <xxhash.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace nightcity::test {

// Offsets are those of SPEC.md, section 3.
inline void fix_checksums(std::vector<std::uint8_t>& bytes) {
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const auto put = [&](std::size_t at, std::uint64_t value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  };
  if (bytes.size() < 64) return;
  std::uint32_t sections = 0;
  std::memcpy(&sections, bytes.data() + 12, sizeof sections);
  const std::uint64_t table = number(24), size = bytes.size();
  put(16, size);
  if (sections <= 64 && table < size && size - table >= std::uint64_t{sections} * 32) {
    for (std::uint32_t i = 0; i < sections; ++i) {
      const std::size_t entry = table + std::size_t{i} * 32;
      std::uint32_t element = 0;
      std::memcpy(&element, bytes.data() + entry + 4, sizeof element);
      const std::uint64_t offset = number(entry + 8), count = number(entry + 16);
      if (offset < size && element > 0 && count <= (size - offset) / element)
        put(entry + 24, XXH64(bytes.data() + offset, element * count, 0));
    }
    put(32, XXH64(bytes.data() + table, std::size_t{sections} * 32, 0));
  }
  put(56, XXH64(bytes.data(), 56, 0));
}

}  // namespace nightcity::test
