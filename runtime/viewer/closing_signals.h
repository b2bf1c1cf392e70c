// Signals that close the window as its user would.
#pragma once

#include <signal.h>

#include <array>

namespace nightcity::viewer {

/// As long as an object lives, INT, TERM and HUP are noted instead of ending the program; one
/// that comes more than a second after the first ends it. A signal that was ignored stays ignored.
class ClosingSignals {
 public:
  ClosingSignals();
  ~ClosingSignals();
  ClosingSignals(const ClosingSignals&) = delete;
  ClosingSignals& operator=(const ClosingSignals&) = delete;

  /// Returns the first that came, or 0.
  static int first();

 private:
  static constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

}  // namespace nightcity::viewer
