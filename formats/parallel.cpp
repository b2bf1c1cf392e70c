#include "formats/parallel.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "formats/cancel.h"

namespace nightcity {

unsigned count_cores() {
  // The standard library counts all cores of the machine, also those that taskset or a container
  // keeps from us.
  cpu_set_t ours;
  if (::sched_getaffinity(0, sizeof ours, &ours) == 0)
    return std::max(1u, static_cast<unsigned>(CPU_COUNT(&ours)));
  return std::max(1u, std::thread::hardware_concurrency());
}

void run_parallel(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  const std::stop_token token = find_cancel_token();
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        if (token.stop_requested()) throw Cancelled();
        work(i);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::jthread> others;
  try {
    for (std::size_t t = 1; t < std::min<std::size_t>(threads, count); ++t)
      others.emplace_back([&] {
        const CancelScope scope(token);
        take();
      });
  } catch (const std::system_error&) {
    // The system gives no more threads: those that there are do the work.
  }
  take();
  others.clear();  // waits for them
  if (failure) std::rethrow_exception(failure);
}

}  // namespace nightcity
