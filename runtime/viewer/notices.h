// Lines of text that the window shows for a while.
#pragma once

#include <string>
#include <vector>

namespace nightcity::viewer {

struct Notice {
  std::string text;
  bool is_error = false;
  double until_s = 0;
};

class Notices {
 public:
  /// Shows a line for a few seconds; errors longer. The same text again starts its time anew.
  void say(const std::string& text, double now_s, bool is_error = false);
  /// Drops lines whose time is over, and returns whether there were any.
  bool expire(double now_s);
  const std::vector<Notice>& lines() const { return lines_; }
  /// Returns the seconds until a line's time is over; infinity without lines.
  double next_change_s(double now_s) const;

 private:
  std::vector<Notice> lines_;
};

}  // namespace nightcity::viewer
