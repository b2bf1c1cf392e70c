#include "tools/nightbake/progress_line.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>

namespace nightcity {

ProgressLine::ProgressLine()
    : active_(::isatty(STDERR_FILENO) && spdlog::should_log(spdlog::level::info)) {}

ProgressSink ProgressLine::sink() {
  if (!active_) return {};
  return [this](const Progress& progress) { show(progress); };
}

void ProgressLine::show(const Progress& progress) {
  // Ten times a second is as much as an eye follows; a new stage shows at once.
  const auto now = std::chrono::steady_clock::now();
  if (progress.stage == stage_ && now - last_ < std::chrono::milliseconds(100)) return;
  stage_ = progress.stage;
  last_ = now;
  std::string line = progress.stage;
  if (progress.count != 0) line += fmt::format(", {} {}", progress.count, progress.unit);
  fmt::print(stderr, "\r\033[K{}", line);
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::clear() {
  if (shown_) fmt::print(stderr, "\r\033[K");
  shown_ = false;
}

}  // namespace nightcity
