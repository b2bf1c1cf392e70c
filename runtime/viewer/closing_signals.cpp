#include "runtime/viewer/closing_signals.h"

#include <time.h>

#include <atomic>

namespace nightcity::viewer {
namespace {

std::atomic<long> first_seen_s{0};  // of the system's clock since it started; 0 = none yet
static_assert(std::atomic<long>::is_always_lock_free);

// Signals to a process group come twice within a moment, from the terminal and from a parent.
constexpr long same_signal_s = 1;

void note(int signal) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);  // may be called in a handler: signal-safety(7)
  const long now_s = now.tv_sec + 1;       // never 0
  long none = 0;
  if (first_seen_s.compare_exchange_strong(none, now_s) || now_s - none <= same_signal_s) return;
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  ::sigaction(signal, &standard, nullptr);
  ::raise(signal);
}

}  // namespace

ClosingSignals::ClosingSignals() {
  first_seen_s = 0;
  struct sigaction noting {};
  noting.sa_handler = note;
  sigemptyset(&noting.sa_mask);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    ::sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) ::sigaction(signals[i], &noting, nullptr);
  }
}

ClosingSignals::~ClosingSignals() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
}

bool ClosingSignals::came() {
  return first_seen_s > 0;
}

}  // namespace nightcity::viewer
