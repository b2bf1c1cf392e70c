// Memory that is about to be written to.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace nightcity {

/// Asks the system for the pages that lie in this memory as a whole, all at once: getting each when
/// it is first written to takes a third longer. Content is kept, and it is no error if the system
/// cannot.
template <class T>
void touch_pages(std::span<T> memory) {
#ifdef MADV_POPULATE_WRITE               // Linux 5.14
  constexpr std::uintptr_t page = 4096;  // the system refuses an address within a larger one
  const auto at = reinterpret_cast<std::uintptr_t>(memory.data());
  const std::uintptr_t first = (at + page - 1) / page * page,
                       end = (at + memory.size_bytes()) / page * page;
  if (first < end) ::madvise(reinterpret_cast<void*>(first), end - first, MADV_POPULATE_WRITE);
#endif
}

}  // namespace nightcity
