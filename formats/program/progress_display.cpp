#include "formats/program/progress_display.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace nightcity::program {
namespace {

using namespace std::chrono_literals;

// Faster than the eye follows would only cost time; a log file gets enough lines to see that work
// goes on.
constexpr auto terminal_interval = 100ms;
constexpr auto log_interval = 30s;

constexpr const char* erase_line = "\r\033[K";

ProgressDisplay::Output make_stderr_output() {
  ProgressDisplay::Output output;
  output.is_terminal = ::isatty(STDERR_FILENO) != 0;
  output.write = [](const std::string& text) {
    if (!spdlog::should_log(spdlog::level::info)) return;
    fmt::print(stderr, "{}", text);
    std::fflush(stderr);
  };
  output.log = [](const std::string& message) { spdlog::info("{}", message); };
  return output;
}

}  // namespace

std::string format_duration(std::chrono::duration<double> duration) {
  const double seconds = duration.count();
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

ProgressDisplay::ProgressDisplay() : ProgressDisplay(make_stderr_output()) {}

ProgressDisplay::ProgressDisplay(Output output)
    : output_(std::move(output)), last_shown_(output_.now()), start_(last_shown_) {}

ProgressDisplay::~ProgressDisplay() {
  clear();
}

void ProgressDisplay::show(const ProgressState& state) {
  const auto now = output_.now();
  if (state.total != total_ || state.done < start_done_) restart_estimate(state, now);
  if (!output_.is_terminal) {
    if (now - last_shown_ < log_interval) return;
    last_shown_ = now;
    return output_.log(to_text(state, now));
  }
  const bool is_finished = state.total != 0 && state.done == state.total;
  const bool is_new = !is_drawn_ || state.what != last_what_ || is_finished;
  if (!is_new && now - last_shown_ < terminal_interval) return;
  last_shown_ = now;
  last_what_ = state.what;
  output_.write(erase_line + to_text(state, now));
  is_drawn_ = true;
}

void ProgressDisplay::clear() {
  if (is_drawn_) output_.write(erase_line);
  is_drawn_ = false;
}

void ProgressDisplay::restart_estimate(const ProgressState& state, Clock::time_point now) {
  total_ = state.total;
  start_ = now;
  start_done_ = state.done;
}

std::string ProgressDisplay::to_text(const ProgressState& state, Clock::time_point now) const {
  if (state.total == 0)
    return state.done == 0 ? state.what
                           : fmt::format("{}, {} {}", state.what, state.done, state.unit);
  std::string text = fmt::format("{}, {}/{} {}", state.what, state.done, state.total, state.unit);
  if (state.done > start_done_ && state.done < state.total) {
    const std::chrono::duration<double> elapsed = now - start_;
    const double rest = static_cast<double>(state.total - state.done) /
                        static_cast<double>(state.done - start_done_);
    text += fmt::format(", {} left", format_duration(elapsed * rest));
  }
  return text;
}

}  // namespace nightcity::program
