#include "tools/ground_cover/closed_along_box.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace nightcity::ground_cover {
namespace {

// The way round a box, anticlockwise from its lower left corner.
class BoxSides {
 public:
  explicit BoxSides(const Box& box) : box_(box), size_(box.high - box.low) {}

  double length() const { return 2 * (size_.x + size_.y); }

  // Returns how far along a place lies, which is that of the nearest side.
  double find(const glm::dvec2& p) const {
    const double south = p.y - box_.low.y, north = box_.high.y - p.y, west = p.x - box_.low.x,
                 east = box_.high.x - p.x;
    const double nearest = std::min(std::min(south, north), std::min(west, east));
    if (nearest == south) return west;
    if (nearest == east) return size_.x + south;
    if (nearest == north) return size_.x + size_.y + east;
    return 2 * size_.x + size_.y + north;
  }

  // Adds the corners on the way from one place to another.
  void add_corners(double from, double to, Ring& ring) const {
    const std::array<double, 4> at{0, size_.x, size_.x + size_.y, 2 * size_.x + size_.y};
    const std::array<glm::dvec2, 4> corners{
        box_.low, {box_.high.x, box_.low.y}, box_.high, {box_.low.x, box_.high.y}};
    const double end = to < from ? to + length() : to;
    for (std::size_t n = 0; n < 8; ++n) {
      const double place = at[n % 4] + (n < 4 ? 0 : length());
      if (from < place && place < end) ring.push_back(corners[n % 4]);
    }
  }

 private:
  Box box_;
  glm::dvec2 size_;
};

struct LineEnd {
  double along;
  std::size_t line;
  bool is_back;
  auto order() const { return std::tie(along, line, is_back); }
};

class Closer {
 public:
  Closer(const std::vector<Line>& lines, const Box& box) : lines_(lines), sides_(box) {
    for (std::size_t n = 0; n < lines.size(); ++n) {
      ends_.push_back({sides_.find(lines[n].front()), n, false});
      ends_.push_back({sides_.find(lines[n].back()), n, true});
    }
    std::sort(ends_.begin(), ends_.end(),
              [](const LineEnd& a, const LineEnd& b) { return a.order() < b.order(); });
    places_.resize(2 * lines.size());
    for (std::size_t n = 0; n < ends_.size(); ++n)
      places_[2 * ends_[n].line + (ends_[n].is_back ? 1 : 0)] = n;
  }

  // Joins each end with the next one round the box: the first, third, ... (`odd` 0) or the second,
  // fourth, ... (1) with the one behind it.
  std::vector<Ring> close(std::size_t odd) const {
    std::vector<Ring> rings;
    std::vector<bool> used(lines_.size());
    for (std::size_t first = 0; first < lines_.size(); ++first) {
      if (used[first]) continue;
      Ring ring;
      std::size_t line = first;
      bool backward = false;
      while (!used[line]) {
        used[line] = true;
        add(lines_[line], backward, ring);
        const std::size_t from = places_[2 * line + (backward ? 0 : 1)];
        const bool goes_up = from % 2 == odd;
        const std::size_t to = (from + (goes_up ? 1 : ends_.size() - 1)) % ends_.size();
        add_side(ends_[from].along, ends_[to].along, goes_up, ring);
        line = ends_[to].line;
        backward = ends_[to].is_back;
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  static void add(const Line& line, bool backward, Ring& ring) {
    if (backward)
      ring.insert(ring.end(), line.rbegin(), line.rend());
    else
      ring.insert(ring.end(), line.begin(), line.end());
  }

  void add_side(double from, double to, bool goes_up, Ring& ring) const {
    Ring corners;
    sides_.add_corners(goes_up ? from : to, goes_up ? to : from, corners);
    if (!goes_up) std::reverse(corners.begin(), corners.end());
    ring.insert(ring.end(), corners.begin(), corners.end());
  }

  const std::vector<Line>& lines_;
  BoxSides sides_;
  std::vector<LineEnd> ends_;        // in their order round the box
  std::vector<std::size_t> places_;  // of each line's front and back among them
};

}  // namespace

std::array<std::vector<Ring>, 2> close_along_box(const std::vector<Line>& lines, const Box& box) {
  if (lines.empty())
    return {{{}, {{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}}}};
  const Closer closer(lines, box);
  return {closer.close(0), closer.close(1)};
}

}  // namespace nightcity::ground_cover
