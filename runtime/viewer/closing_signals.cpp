#include "runtime/viewer/closing_signals.h"

#include <time.h>

#include <atomic>
#include <limits>

namespace nightcity::viewer {
namespace {

constexpr long never_s = std::numeric_limits<long>::max();

std::atomic<int> first_signal{0};         // 0 = none yet
std::atomic<long> first_seen_s{never_s};  // of the system's clock since it started
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<long>::is_always_lock_free);

// Signals to a process group come twice within a moment, from the terminal and from a parent.
constexpr long same_signal_s = 1;

void note(int signal) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);  // may be called in a handler: signal-safety(7)
  int none = 0;
  if (first_signal.compare_exchange_strong(none, signal)) {
    first_seen_s = now.tv_sec;
    return;
  }
  if (now.tv_sec - first_seen_s.load() <= same_signal_s) return;
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  ::sigaction(signal, &standard, nullptr);
  ::raise(signal);
}

}  // namespace

ClosingSignals::ClosingSignals() {
  first_seen_s = never_s;
  first_signal = 0;
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

int ClosingSignals::first() {
  return first_signal;
}

}  // namespace nightcity::viewer
