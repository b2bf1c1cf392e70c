// A library to load before others (LD_PRELOAD): puts every block that starts with a page right
// before pages that nobody may touch. Mesa's CPU driver keeps the buffers of the device in such
// blocks, so a shader that reads or writes beyond a buffer ends the program, with a line that says
// by how much. Sanitizers do not see what compiled shaders do. Blocks end on 16 bytes, which is as
// exact as this is.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

constexpr std::size_t page = 4096, guard = 64 * page, max_blocks = 1 << 16;

struct Block {
  char* begin;  // nullptr: this entry is free
  char* mapping;
  std::size_t bytes, mapped;
};

// Plain memory: containers would call malloc and free, which are what is replaced here.
Block blocks[max_blocks];
std::size_t used_blocks = 0;
pthread_mutex_t blocks_mutex = PTHREAD_MUTEX_INITIALIZER;

void* allocate_before_guard(std::size_t bytes) {
  if (bytes > SIZE_MAX - 2 * guard) return nullptr;
  const std::size_t room = (bytes + page - 1) / page * page;
  void* const mapped = mmap(nullptr, room + guard, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  char* const mapping = static_cast<char*>(mapped);
  mprotect(mapping + room, guard, PROT_NONE);
  char* const begin = mapping + (room - bytes) / 16 * 16;
  pthread_mutex_lock(&blocks_mutex);
  std::size_t i = 0;
  while (i < used_blocks && blocks[i].begin) ++i;
  if (i == max_blocks) std::abort();
  if (i == used_blocks) ++used_blocks;
  blocks[i] = {begin, mapping, bytes, room + guard};
  pthread_mutex_unlock(&blocks_mutex);
  return begin;
}

// Returns false if this memory is not one of the blocks.
bool release_block(void* memory) {
  Block block{};
  pthread_mutex_lock(&blocks_mutex);
  for (std::size_t i = 0; i < used_blocks && !block.begin; ++i)
    if (blocks[i].begin == memory) {
      block = blocks[i];
      blocks[i].begin = nullptr;
    }
  pthread_mutex_unlock(&blocks_mutex);
  if (block.begin) munmap(block.mapping, block.mapped);
  return block.begin != nullptr;
}

// Says which block a fault lies behind, and lets the fault end the program.
void tell_fault(int, siginfo_t* info, void*) {
  const char* const at = static_cast<const char*>(info->si_addr);
  for (std::size_t i = 0; i < used_blocks; ++i) {
    const Block& block = blocks[i];
    if (!block.begin || at < block.begin || at >= block.mapping + block.mapped) continue;
    char text[120];
    const int length = std::snprintf(text, sizeof text,
                                     "guard pages: access at byte %zu of a block of %zu bytes\n",
                                     static_cast<std::size_t>(at - block.begin), block.bytes);
    if (write(STDERR_FILENO, text, static_cast<std::size_t>(length)) < 0) break;
  }
  std::signal(SIGSEGV, SIG_DFL);
}

[[gnu::constructor]] void install() {
  struct sigaction action {};
  action.sa_sigaction = tell_fault;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSEGV, &action, nullptr);
}

template <class Function>
Function find_next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int posix_memalign(void** out, std::size_t alignment, std::size_t bytes) noexcept {
  static const auto next = find_next<int (*)(void**, std::size_t, std::size_t)>("posix_memalign");
  if (alignment != page) return next(out, alignment, bytes);
  void* const memory = allocate_before_guard(bytes);
  if (!memory) return ENOMEM;
  *out = memory;
  return 0;
}

extern "C" void free(void* memory) noexcept {
  static const auto next = find_next<void (*)(void*)>("free");
  if (memory && used_blocks > 0 && release_block(memory)) return;
  next(memory);
}
