#include "runtime/viewer/notices.h"

#include <algorithm>
#include <limits>

namespace nightcity::viewer {
namespace {

constexpr double shown_s = 6, error_shown_s = 15;
constexpr std::size_t max_lines = 4;

}  // namespace

void Notices::say(const std::string& text, double now_s, bool is_error) {
  std::erase_if(lines_, [&](const Notice& line) { return line.text == text; });
  if (lines_.size() == max_lines) lines_.erase(lines_.begin());
  lines_.push_back({text, is_error, now_s + (is_error ? error_shown_s : shown_s)});
}

bool Notices::expire(double now_s) {
  return std::erase_if(lines_, [&](const Notice& line) { return line.until_s <= now_s; }) > 0;
}

double Notices::next_change_s(double now_s) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Notice& line : lines_) least = std::min(least, line.until_s - now_s);
  return std::max(0.0, least);
}

}  // namespace nightcity::viewer
