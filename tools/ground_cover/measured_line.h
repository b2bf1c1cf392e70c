// A line with the distance of each of its points from its start.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

namespace nightcity::ground_cover {

/// The line has at least two points, and must outlive it.
class MeasuredLine {
 public:
  explicit MeasuredLine(const std::vector<glm::dvec2>& line);
  double length_m() const { return at_m_.back(); }
  double at(std::size_t i) const { return at_m_[i]; }

  /// Returns the corners of a strip from `from_m` to `to_m` along the line, between two distances
  /// to its left. A strip is straight: a bend within it becomes its chord.
  std::vector<glm::dvec2> make_strip(double from_m, double to_m, double right_m,
                                     double left_m) const;
  /// Returns a place beside the line.
  glm::dvec2 find_beside(double s, double left_m) const;
  /// Returns the part of the line between two distances from its start, with its bends.
  std::vector<glm::dvec2> cut(double from_m, double to_m) const;

 private:
  std::pair<glm::dvec2, glm::dvec2> find(double s) const;

  const std::vector<glm::dvec2>& line_;
  std::vector<double> at_m_;
};

/// Returns one strip for each segment of a line, between two distances to its left. Neighbours
/// share the corners at a bend, which are mitred up to a corner of 60 degrees.
std::vector<std::vector<glm::dvec2>> make_strips(const std::vector<glm::dvec2>& line,
                                                 double right_m, double left_m);

}  // namespace nightcity::ground_cover
