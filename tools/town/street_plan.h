// The town's grid of streets and blocks, bent and jittered. Each part is a function of its column
// and row alone, so that a town of any size needs no memory. Lengths in metres from the town's
// origin (x east, y north).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "tools/town/town.h"

namespace nightcity::town {

enum class StreetClass {
  primary,
  secondary,
  tertiary,
  residential,
  living_street,
  pedestrian,
  footway
};

struct StreetSize {
  double carriageway_m;  // kerb to kerb
  double pavement_m;     // each side
  double lamp_spacing_m;
};
StreetSize size_of(StreetClass street);
const char* osm_name(StreetClass street);

enum class BlockUse { market, park, courtyard, perimeter, slabs, hall, houses };

/// Corners counter-clockwise from the south-west; side k runs from corner k to corner k + 1.
using Quad = std::array<glm::dvec2, 4>;

class StreetPlan {
 public:
  explicit StreetPlan(const TownOptions& options);

  int columns() const { return columns_; }
  int rows() const { return rows_; }

  /// Returns the crossing of the centrelines of column street i and row street j. Defined beyond
  /// the town too.
  glm::dvec2 node(int i, int j) const;
  StreetClass row_street(int i, int j) const;     // node (i, j) to (i + 1, j)
  StreetClass column_street(int i, int j) const;  // node (i, j) to (i, j + 1)

  /// Block (i, j) inside its kerbs, and inside its pavements: houses stay inside the second.
  Quad kerb(int i, int j) const { return inset(i, j, false); }
  Quad parcel(int i, int j) const { return inset(i, j, true); }
  BlockUse use(int i, int j) const;
  /// 0 at the market square, 1 at the town's edge.
  double remoteness(int i, int j) const;

  glm::dvec2 low() const { return low_; }  // bounds of the streets
  glm::dvec2 high() const { return high_; }

 private:
  Quad inset(int i, int j, bool behind_pavement) const;
  StreetClass side_street(int i, int j, int side) const;

  std::uint64_t seed_;
  int columns_, rows_;
  std::vector<double> column_x_, row_y_;  // one more than streets at each end
  glm::dvec2 phase_, low_{0}, high_{0};
};

/// Returns the point in which the lines a + t u and b + t v meet.
glm::dvec2 meet(const glm::dvec2& a, const glm::dvec2& u, const glm::dvec2& b, const glm::dvec2& v);

/// Returns a convex counter-clockwise quad with side k moved inwards by distance[k].
Quad inset_quad(const Quad& quad, const std::array<double, 4>& distance);

}  // namespace nightcity::town
