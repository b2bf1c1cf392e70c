// The surface lamps stand on: triangles of the model, searched by vertical rays.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formats/atomic_file.h"
#include "tools/mesh/triangle_mesh.h"

namespace nightcity {

/// What a vertical ray may land on; on one vertical line the lower class wins, then the greater height.
enum class Footing : std::uint8_t { terrain = 0, road = 1, ground_surface = 2, roof = 3 };

class Terrain {
 public:
  /// Triangles lie in scratch files beside `scratch` (by default in the system's folder for such), so that
  /// memory does not grow with the city.
  explicit Terrain(const std::filesystem::path& scratch = scratch_folder() /
                                                          "terrain");
  ~Terrain();
  Terrain(Terrain&&) noexcept;
  Terrain& operator=(Terrain&&) noexcept;

  /// Adds triangles (E, N, H in metres) of one class. Call before build(). Vertical, degenerate and
  /// non-finite triangles carry nobody and are left out.
  void add(const TriangleMesh& mesh, Footing footing);
  /// Adds mass points of the model's relief.
  void add_points(std::span<const glm::dvec3> points);
  /// Adds a break line of the model's relief: what build() makes has its pieces for edges. False where more
  /// have come than are kept, and only its vertices count, as mass points.
  bool add_break_line(const std::vector<glm::dvec3>& line);

  /// Whether the model brings its own ground: triangles of terrain, or points of it.
  bool has_relief() const;
  /// Where the buildings stand (else where the roads lie), thinned to some 100,000: what another ground must
  /// fit to. Empty after build().
  const std::vector<glm::dvec3>& feet() const;

  /// Where no terrain was added, makes a Delaunay surface through the relief's points, else through the
  /// ground surfaces' vertices, else the roads', reaching `margin_m` beyond their bounds, so that every city
  /// stands on something. It counts as terrain. Of several vertices on one vertical line the lowest is taken.
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

  /// How many pieces of break lines are edges of the made surface, and how many are not, for they cross
  /// others too often.
  struct BreakEdges {
    std::size_t used = 0, unused = 0;
  };
  BreakEdges break_edges() const;

  /// The surface made by build() where none was given; empty mesh otherwise.
  const TriangleMesh& made_surface() const;
  /// Forgets it, once it has been used.
  void drop_made_surface();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
