// Vectors of many megabytes.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace nightcity {

/// Does not write to new elements: the threads that fill them also take their memory, and no core
/// fills it with zeros first. The memory of large vectors is of huge pages, where the system has
/// them: a page of 4 kB takes as long to get as a hundred triangles to convert.
template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < min_large) return static_cast<T*>(::operator new(bytes, alignment()));
    void* memory = ::operator new (bytes, std::align_val_t{huge_page});
    ::madvise(memory, bytes, MADV_HUGEPAGE);  // advice: that it fails is no error
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    ::operator delete (memory,
                       count * sizeof(T) < min_large ? alignment() : std::align_val_t{huge_page});
  }
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }

 private:
  static constexpr std::size_t huge_page = std::size_t{2} << 20, min_large = 4 * huge_page;
  static constexpr std::align_val_t alignment() { return std::align_val_t{alignof(T)}; }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace nightcity
