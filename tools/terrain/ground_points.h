// Points for a surface of the ground, thinned so that their number stays bounded for any city.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace nightcity::terrain {

/// Keeps up to `max_points`; beyond, the lowest of each square of a grid whose spacing doubles as
/// often as needed. The same points in the same order give the same result.
class GroundPoints {
 public:
  explicit GroundPoints(std::size_t max_points = 250'000) : max_points_(max_points) {}

  /// E, N, H in metres. Points that are not finite are left out.
  void add(const glm::dvec3& p);
  bool empty() const { return points_.empty(); }
  const std::vector<glm::dvec3>& points() const { return points_; }
  std::vector<glm::dvec3> take();
  /// Returns the spacing of the grid, m; 0 = every point was kept.
  double spacing_m() const { return spacing_; }

 private:
  void thin();

  std::size_t max_points_;
  double spacing_ = 0;
  std::vector<glm::dvec3> points_;
};

}  // namespace nightcity::terrain
