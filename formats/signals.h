// Removes what would be left behind when a signal ends the program.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace nightcity {

/// Makes INT, TERM, HUP, QUIT and PIPE remove every Leftover before they end the program, which
/// still ends by that signal: a shell reports 128 + its number. A signal that the program was
/// started with as ignored (nohup) stays ignored. A file that outgrows its limit (XFSZ) becomes an
/// error of the write. A mapped file that another program cuts short while it is read (BUS) ends
/// the program with `bad_data` and a message that names `program` and the file. `program` must live
/// as long as the process.
void install_signal_handlers(const char* program);

/// A file or folder that a signal must not leave behind, registered as long as the object lives.
/// Folders are removed where they are empty, after all files, the last registered first; trees with
/// all that is in them, without following links.
class Leftover {
 public:
  enum class Kind { file, folder, tree };
  Leftover() = default;
  Leftover(const std::filesystem::path& path, Kind kind);
  ~Leftover();
  Leftover(Leftover&& other) noexcept;
  Leftover& operator=(Leftover&& other) noexcept;

 private:
  std::size_t slot_ = no_slot;
  static constexpr std::size_t no_slot = static_cast<std::size_t>(-1);
};

/// Keeps signals that end the program waiting until it is destroyed: for a few renames that belong
/// together, and for what is made until it is registered as a Leftover.
class SignalHold {
 public:
  SignalHold();
  ~SignalHold();
  SignalHold(const SignalHold&) = delete;
  SignalHold& operator=(const SignalHold&) = delete;
};

/// Names a mapped file in the message about one that was cut short, as long as the object lives.
class MappedRange {
 public:
  MappedRange() = default;
  MappedRange(std::span<const std::byte> bytes, const std::filesystem::path& path);
  ~MappedRange();
  MappedRange(MappedRange&& other) noexcept;
  MappedRange& operator=(MappedRange&& other) noexcept;

 private:
  std::size_t slot_ = no_slot;
  static constexpr std::size_t no_slot = static_cast<std::size_t>(-1);
};

}  // namespace nightcity
