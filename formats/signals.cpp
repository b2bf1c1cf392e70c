// Handlers run between any two instructions of any thread, so they call async-signal-safe functions
// alone (signal-safety(7)) and read tables of atomics that never move.
#include "formats/signals.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

#include "formats/error.h"

namespace nightcity {
namespace {

constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};

// The text of a slot is written before `used` is set, and not changed while it is.
struct PathSlot {
  std::atomic<bool> used{false};
  std::array<char, PATH_MAX> path{};
};
struct LeftoverSlot : PathSlot {
  std::atomic<Leftover::Kind> kind{Leftover::Kind::file};
};
struct MappedSlot : PathSlot {
  std::atomic<std::uintptr_t> begin{0}, end{0};
};

// More than a program ever holds at once. What finds no slot is not registered: a signal then
// leaves it behind.
std::array<LeftoverSlot, 64> leftovers;
std::array<MappedSlot, 256> mapped_files;
std::mutex slots_mutex;  // between threads that register; handlers never take it

std::atomic<int> holds{0}, waiting_signal{0};
// Set while a handler removes what is left: what another thread were to make now would stay.
std::atomic<bool> is_ending{false};
std::atomic<const char*> program_name{"nightcity"};

// Under slots_mutex. Returns the number of slots where all are taken.
template <class Slots>
std::size_t find_free_slot(const Slots& slots) {
  std::size_t n = 0;
  while (n < slots.size() && slots[n].used) ++n;
  return n;
}

template <class Slots>
void release_slot(Slots& slots, std::size_t slot) {
  if (slot < slots.size()) slots[slot].used = false;
}

// Returns false where the name has no room: half a name is another file.
bool set_path(PathSlot& slot, const std::filesystem::path& path) {
  const std::string text = path.string();
  if (text.size() >= slot.path.size()) return false;
  std::memcpy(slot.path.data(), text.c_str(), text.size() + 1);
  slot.used = true;
  return true;
}

// getdents64(2) fills this in; readdir(3) takes memory, which a handler may not.
struct FolderEntry {
  std::uint64_t inode;
  std::int64_t offset;
  std::uint16_t size;
  unsigned char type;
  char name[1];
};

// Removes `path`, which is relative to the folder `parent`, and what is in it, `levels` of folders
// deep: deeper than any that we make, and no deeper than the handler's stack.
void remove_tree(int parent, const char* path, int levels) {
  const int folder =
      ::openat(parent, path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (folder < 0) return;
  // From the start again as long as something goes: what is removed moves the others' places.
  for (bool removed = levels > 0; removed;) {
    removed = false;
    ::lseek(folder, 0, SEEK_SET);
    alignas(FolderEntry) std::array<char, 2048> entries;
    long size = 0;
    while ((size = ::syscall(SYS_getdents64, folder, entries.data(), entries.size())) > 0)
      for (long at = 0; at < size;) {
        const auto* entry = reinterpret_cast<const FolderEntry*>(entries.data() + at);
        at += entry->size;
        if (std::strcmp(entry->name, ".") == 0 || std::strcmp(entry->name, "..") == 0) continue;
        if (::unlinkat(folder, entry->name, 0) == 0)
          removed = true;
        else
          remove_tree(folder, entry->name, levels - 1);
      }
  }
  ::close(folder);
  ::unlinkat(parent, path, AT_REMOVEDIR);
}

void remove_leftovers() {
  constexpr int max_levels = 4;
  for (const LeftoverSlot& slot : leftovers) {
    if (slot.used && slot.kind == Leftover::Kind::file) ::unlink(slot.path.data());
    if (slot.used && slot.kind == Leftover::Kind::tree)
      remove_tree(AT_FDCWD, slot.path.data(), max_levels);
  }
  // Folders in folders, in any order: again as long as one more is empty.
  for (bool removed = true; removed;) {
    removed = false;
    for (const LeftoverSlot& slot : leftovers)
      if (slot.used && slot.kind == Leftover::Kind::folder && ::rmdir(slot.path.data()) == 0)
        removed = true;
  }
}

void end_by(int signal) {
  remove_leftovers();
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  ::sigaction(signal, &standard, nullptr);
  ::raise(signal);  // delivered when the handler returns, as it is blocked meanwhile
}

// Whoever holds signals either is seen here, or sees `is_ending` and waits for the end.
void on_ending_signal(int signal) {
  is_ending.store(true);
  if (holds.load() == 0) return end_by(signal);
  waiting_signal.store(signal);
  is_ending.store(false);
  // The last hold may have ended before it could see that a signal waits.
  if (holds.load() > 0) return;
  if (const int waiting = waiting_signal.exchange(0)) on_ending_signal(waiting);
}

void print(const char* text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
}

void on_bus_error(int signal, siginfo_t* info, void*) {
  const auto place = reinterpret_cast<std::uintptr_t>(info->si_addr);
  for (const MappedSlot& slot : mapped_files) {
    if (!slot.used || place < slot.begin || place >= slot.end) continue;
    print(program_name.load());
    print(": error: ");
    print(slot.path.data());
    print(": became shorter, or could not be read, while it was in use\n");
    remove_leftovers();
    ::_exit(static_cast<int>(ExitCode::bad_data));
  }
  end_by(signal);
}

}  // namespace

void install_signal_handlers(const char* program) {
  program_name.store(program);
  for (const int signal : ending_signals) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    struct sigaction ours {};
    ours.sa_handler = on_ending_signal;
    ours.sa_flags = SA_RESTART;
    ::sigaction(signal, &ours, nullptr);
  }
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGXFSZ, &ignore, nullptr);
  struct sigaction bus {};
  bus.sa_sigaction = on_bus_error;
  bus.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &bus, nullptr);
}

Leftover::Leftover(const std::filesystem::path& path, Kind kind) {
  const std::lock_guard lock(slots_mutex);
  const std::size_t slot = find_free_slot(leftovers);
  if (slot == leftovers.size()) return;
  leftovers[slot].kind = kind;
  // Absolute: the working folder may change.
  if (set_path(leftovers[slot], std::filesystem::absolute(path))) slot_ = slot;
}

Leftover::~Leftover() {
  release_slot(leftovers, slot_);
}
Leftover::Leftover(Leftover&& other) noexcept : slot_(std::exchange(other.slot_, no_slot)) {}
Leftover& Leftover::operator=(Leftover&& other) noexcept {
  std::swap(slot_, other.slot_);
  return *this;
}

SignalHold::SignalHold() {
  for (;;) {
    ++holds;
    if (!is_ending.load()) return;
    --holds;
    ::usleep(1000);
  }
}
SignalHold::~SignalHold() {
  if (--holds > 0) return;
  if (const int signal = waiting_signal.exchange(0)) on_ending_signal(signal);
}

MappedRange::MappedRange(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  const std::lock_guard lock(slots_mutex);
  const std::size_t slot = find_free_slot(mapped_files);
  if (slot == mapped_files.size()) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(bytes.data());
  mapped_files[slot].begin = begin;
  mapped_files[slot].end = begin + bytes.size();
  if (set_path(mapped_files[slot], path)) slot_ = slot;
}

MappedRange::~MappedRange() {
  release_slot(mapped_files, slot_);
}
MappedRange::MappedRange(MappedRange&& other) noexcept
    : slot_(std::exchange(other.slot_, no_slot)) {}
MappedRange& MappedRange::operator=(MappedRange&& other) noexcept {
  std::swap(slot_, other.slot_);
  return *this;
}

}  // namespace nightcity
