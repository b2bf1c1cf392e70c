// Lets operator new by mimalloc throw std::bad_alloc, as the standard has it. mimalloc's own, where
// the library is compiled as C (Debian's is), finds no handler and aborts without a word.
#include <mimalloc.h>

#include <cstddef>
#include <new>

namespace {

void* require_memory(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return require_memory(mi_malloc(size));
}
void* operator new[](std::size_t size) {
  return require_memory(mi_malloc(size));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return mi_malloc(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return mi_malloc(size);
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  return require_memory(mi_malloc_aligned(size, std::size_t(alignment)));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return require_memory(mi_malloc_aligned(size, std::size_t(alignment)));
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return mi_malloc_aligned(size, std::size_t(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return mi_malloc_aligned(size, std::size_t(alignment));
}

// The deletes are replaced with the news, as compilers ask: mimalloc frees what either allocated.
void operator delete(void* memory) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  mi_free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  mi_free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  mi_free(memory);
}
