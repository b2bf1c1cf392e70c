// The surface on which lamps stand: triangles of the model, searched by vertical rays.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "formats/file_names.h"
#include "tools/mesh/triangle_mesh.h"
#include "tools/terrain/surface_store.h"

namespace nightcity::terrain {

/// The surfaces that a vertical ray may meet. On one vertical line the first class wins, then the
/// greater height.
enum class SurfaceClass : std::uint8_t { terrain = 0, road = 1, ground_surface = 2, roof = 3 };

class Terrain {
 public:
  /// Triangles lie in scratch files beside `scratch` (by default in the system's temporary folder),
  /// so that memory does not grow with the city.
  explicit Terrain(const std::filesystem::path& scratch = scratch_folder() / "terrain");
  ~Terrain();
  Terrain(Terrain&&) noexcept;
  Terrain& operator=(Terrain&&) noexcept;

  /// Adds triangles (E, N, H in metres) of one class. build() makes no surface where some of
  /// terrain have come. Vertical, degenerate and non-finite triangles are left out: nothing can
  /// stand on them.
  void add(const mesh::TriangleMesh& mesh, SurfaceClass surface_class);
  /// Adds mass points of the model's relief.
  void add_points(std::span<const glm::dvec3> points);
  /// Adds a break line of the model's relief: its pieces become edges of the surface that build()
  /// makes. Returns false where there are already too many lines; then only its vertices count, as
  /// mass points.
  bool add_break_line(const std::vector<glm::dvec3>& line);

  /// Returns whether the model has a ground of its own: triangles of terrain, or points of it.
  bool has_relief() const;
  /// Returns the extent of the terrain; none where there is none.
  std::optional<Extent> extent() const;
  /// Returns vertices of the buildings' ground surfaces (without any, of the roads), thinned to
  /// some 100,000: another ground must fit to them. Empty after build().
  const std::vector<glm::dvec3>& footprint_points() const;

  /// If no terrain was added, makes a Delaunay surface through the relief's points, else the
  /// ground surfaces' vertices, else the roads', reaching `margin_m` beyond their bounds and over
  /// all of `reach`, so that every city has a ground. It counts as terrain. Of several vertices on
  /// one vertical line the lowest is taken. The surface is thinned by thin_surface where
  /// `max_error_m` is above 0.
  void build(double margin_m, double max_error_m = 0, const std::optional<Extent>& reach = {});

  struct Hit {
    double height_m;
    SurfaceClass surface;
  };
  /// Returns the surface below or above (E, N); none outside the model. May be called from many
  /// threads after build() while nothing is added.
  std::optional<Hit> height_at(const glm::dvec2& east_north) const;
  /// Returns the height of the topmost triangle of one class on the vertical line through (E, N).
  std::optional<double> height_of(SurfaceClass surface_class, const glm::dvec2& east_north) const;
  /// Returns whether a roof or a building's ground surface lies on the vertical line through (E,
  /// N).
  bool inside_building(const glm::dvec2& east_north) const;

  /// The number of pieces of break lines that are edges of the made surface, and of those that are
  /// not because they cross others too often.
  struct BreakEdges {
    std::size_t used = 0, unused = 0;
  };
  BreakEdges break_edges() const;

  /// Returns the surface made by build() where none was given, otherwise an empty mesh.
  const mesh::TriangleMesh& made_surface() const;
  /// Frees its memory.
  void drop_made_surface();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity::terrain
