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

  /// Adds triangles (E, N, H in metres) of one class. Call before build().
  void add(const TriangleMesh& mesh, Footing footing);
  /// Builds the trees. Where no terrain was added, makes a Delaunay surface through the ground surfaces'
  /// vertices, reaching `margin_m` beyond their bounds, so that every city stands on something.
  void build(double margin_m);

  struct Hit {
    double height_m;
    Footing footing;
  };
  /// Height below or above (E, N); empty outside the model.
  std::optional<Hit> height_at(const glm::dvec2& east_north) const;

  /// The surface made by build() where none was given; empty mesh otherwise.
  const TriangleMesh& made_surface() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
