#include "tools/ground_cover/join_lines.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

namespace nightcity::ground_cover {

namespace {

class Joiner {
 public:
  explicit Joiner(std::vector<Line> lines) : lines_(std::move(lines)), used_(lines_.size()) {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      ends_[lines_[i].front()].push_back(i);
      ends_[lines_[i].back()].push_back(i);
    }
  }

  std::vector<Line> join() {
    std::vector<Line> joined;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (used_[i]) continue;
      used_[i] = true;
      Line line = lines_[i];
      extend(line);
      std::reverse(line.begin(), line.end());
      extend(line);
      if (comes_before(line.back(), line.front())) std::reverse(line.begin(), line.end());
      joined.push_back(std::move(line));
    }
    return joined;
  }

 private:
  // Adds to the line's back what goes on there.
  void extend(Line& line) {
    while (const auto next = find_next(line.back())) {
      used_[*next] = true;
      Line piece = lines_[*next];
      if (piece.front() != line.back()) std::reverse(piece.begin(), piece.end());
      line.insert(line.end(), piece.begin() + 1, piece.end());
    }
  }

  // Returns the only line that is not used and ends at a point where two lines end.
  std::optional<std::size_t> find_next(const glm::dvec2& point) const {
    const std::vector<std::size_t>& ends = ends_.at(point);
    if (ends.size() != 2) return std::nullopt;
    for (const std::size_t line : ends)
      if (!used_[line]) return line;
    return std::nullopt;
  }

  std::vector<Line> lines_;
  std::vector<bool> used_;
  std::map<glm::dvec2, std::vector<std::size_t>, PointOrder> ends_;
};

}  // namespace

std::vector<Line> join_lines(std::vector<Line> lines) {
  const auto order = [](const Line& a, const Line& b) { return comes_before(a, b); };
  // A line and its reverse are the same.
  for (Line& line : lines)
    if (runs_back(line)) std::reverse(line.begin(), line.end());
  std::sort(lines.begin(), lines.end(), order);
  std::vector<Line> joined = Joiner(std::move(lines)).join();
  std::sort(joined.begin(), joined.end(), order);
  return joined;
}

}  // namespace nightcity::ground_cover
