#include "tools/ground_cover/measured_line.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace nightcity::ground_cover {
namespace {

glm::dvec2 turn_left(const glm::dvec2& along) {
  return {-along.y, along.x};
}

// Returns what leads from each point of a line one metre to the left of it: at bends of both
// segments, along the line that halves the angle between them.
std::vector<glm::dvec2> find_sides(const std::vector<glm::dvec2>& line) {
  std::vector<glm::dvec2> normals;  // of segments
  for (std::size_t i = 1; i < line.size(); ++i) {
    const glm::dvec2 along = line[i] - line[i - 1];
    const double length = glm::length(along);
    normals.push_back(length > 0 ? turn_left(along / length)
                      : i > 1    ? normals.back()
                                 : glm::dvec2(0, 1));
  }
  std::vector<glm::dvec2> sides{normals.front()};
  // One plus the cosine of the turn is at least a half where the corner is of 60 degrees or more.
  constexpr double min_share = 0.5;
  for (std::size_t i = 1; i < normals.size(); ++i) {
    const double share = 1 + glm::dot(normals[i - 1], normals[i]);
    sides.push_back((normals[i - 1] + normals[i]) / std::max(share, min_share));
  }
  sides.push_back(normals.back());
  return sides;
}

}  // namespace

MeasuredLine::MeasuredLine(const std::vector<glm::dvec2>& line) : line_(line), at_m_{0} {
  for (std::size_t i = 1; i < line.size(); ++i)
    at_m_.push_back(at_m_.back() + glm::distance(line[i - 1], line[i]));
}

std::vector<glm::dvec2> MeasuredLine::make_strip(double from_m, double to_m, double right_m,
                                                 double left_m) const {
  return {find_beside(from_m, right_m), find_beside(to_m, right_m), find_beside(to_m, left_m),
          find_beside(from_m, left_m)};
}

glm::dvec2 MeasuredLine::find_beside(double s, double left_m) const {
  const auto [place, along] = find(s);
  return place + turn_left(along) * left_m;
}

std::vector<glm::dvec2> MeasuredLine::cut(double from_m, double to_m) const {
  std::vector<glm::dvec2> part{find(from_m).first};
  for (std::size_t i = 0; i < line_.size(); ++i)
    if (at_m_[i] > from_m && at_m_[i] < to_m) part.push_back(line_[i]);
  part.push_back(find(to_m).first);
  return part;
}

// Returns a place and the direction of the line there.
std::pair<glm::dvec2, glm::dvec2> MeasuredLine::find(double s) const {
  const auto next = std::lower_bound(at_m_.begin() + 1, at_m_.end() - 1, s);
  const auto i = static_cast<std::size_t>(next - at_m_.begin());
  const double length = at_m_[i] - at_m_[i - 1];
  if (!(length > 0)) return {line_[i], {1, 0}};
  const glm::dvec2 along = (line_[i] - line_[i - 1]) / length;
  return {line_[i - 1] + along * (s - at_m_[i - 1]), along};
}

std::vector<std::vector<glm::dvec2>> make_strips(const std::vector<glm::dvec2>& line,
                                                 double right_m, double left_m) {
  if (line.size() < 2) return {};
  const std::vector<glm::dvec2> sides = find_sides(line);
  std::vector<std::vector<glm::dvec2>> strips;
  for (std::size_t i = 1; i < line.size(); ++i)
    strips.push_back({line[i - 1] + sides[i - 1] * right_m, line[i] + sides[i] * right_m,
                      line[i] + sides[i] * left_m, line[i - 1] + sides[i - 1] * left_m});
  return strips;
}

}  // namespace nightcity::ground_cover
