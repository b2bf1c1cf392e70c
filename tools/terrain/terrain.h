// The surface lamps stand on: triangles of the model, searched by vertical rays (CGAL AABB tree).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tools/mesh/triangle_mesh.h"

namespace nightcity {

/// What a vertical ray may land on; on one vertical line the lower class wins, then the greater height.
enum class Footing : std::uint8_t { terrain = 0, road = 1, ground_surface = 2, roof = 3 };

class Terrain {
 public:
  Terrain();
  ~Terrain();
  Terrain(Terrain&&) noexcept;
  Terrain& operator=(Terrain&&) noexcept;

  /// Adds triangles (E, N, H in metres) of one class. Call before build(). Vertical, degenerate and
  /// non-finite triangles carry nobody and are left out.
  void add(const TriangleMesh& mesh, Footing footing);
  /// Builds the trees. Where no terrain was added, makes a Delaunay surface through the ground surfaces'
  /// vertices (else the roads'), reaching `margin_m` beyond their bounds, so that every city stands on
  /// something. It counts as terrain. Of several vertices on one vertical line the lowest is taken.
  void build(double margin_m);

  struct Hit {
    double height_m;
    Footing footing;
  };
  /// Height below or above (E, N); empty outside the model. May be called from many threads after build().
  std::optional<Hit> height_at(const glm::dvec2& east_north) const;
  /// Height of the topmost triangle of one class on the vertical line through (E, N).
  std::optional<double> height_of(Footing footing, const glm::dvec2& east_north) const;
  /// Whether a roof or a building's ground surface lies on the vertical line through (E, N).
  bool inside_building(const glm::dvec2& east_north) const;

  /// The surface made by build() where none was given; empty mesh otherwise.
  const TriangleMesh& made_surface() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
