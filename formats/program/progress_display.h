// Shows on stderr the progress of long work and the time that it still needs.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace nightcity::program {

/// A state of the work: `done` of `total` units of `what`.
struct ProgressState {
  std::string what;         // "rendering", "reading 2 of 9: 3910_5820.gml"
  std::uint64_t done = 0;   // 0 is not printed unless `total` is known
  std::uint64_t total = 0;  // 0 = unknown: then no time left is printed
  std::string unit;         // "frames"
};

/// Returns a duration in two units at most: "3.2 s", "48 s", "4 min 10 s", "2 h 5 min".
std::string format_duration(std::chrono::duration<double> duration);

/// Shows the progress of one piece of work. On a terminal this is one line, redrawn ten times a
/// second at most and erased by the destructor. Elsewhere (a log file) it is one message each half
/// minute, so short work prints none. With -q nothing is shown.
class ProgressDisplay {
 public:
  using Clock = std::chrono::steady_clock;
  struct Output {
    bool is_terminal = false;
    std::function<void(const std::string&)> write;  // raw text for the terminal
    std::function<void(const std::string&)> log;    // one message
    std::function<Clock::time_point()> now = Clock::now;
  };

  ProgressDisplay();  // on stderr
  explicit ProgressDisplay(Output output);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Says how far the work is. The time left assumes that the rest goes as fast as what was done
  /// since the first call with this `total`.
  void show(const ProgressState& state);
  /// Erases the line, to print something else; the next call of show draws it again.
  void clear();

 private:
  std::string to_text(const ProgressState& state, Clock::time_point now) const;
  void restart_estimate(const ProgressState& state, Clock::time_point now);

  Output output_;
  bool is_drawn_ = false;
  std::string last_what_;
  Clock::time_point last_shown_;
  // The estimate of the time left counts from this moment and this number of steps.
  Clock::time_point start_;
  std::uint64_t start_done_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace nightcity::program
