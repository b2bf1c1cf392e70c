// Work that several threads share.
#pragma once

#include <cstddef>
#include <functional>

namespace nightcity {

/// Returns the number of cores that this process may use, at least 1.
unsigned count_cores();

/// Calls `work(i)` once for every i < count, on at most `threads` threads, of which the caller's is
/// one. Indices are handed out in ascending order. When a call throws, no more are begun, and the
/// first exception is thrown again after all threads have ended: Cancelled, for one, where the
/// caller's token asks for an end (cancel.h).
void run_parallel(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& work);

}  // namespace nightcity
