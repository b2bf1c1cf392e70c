// A ground from elevation models: a grid of heights, tile by tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "tools/bake/city/ground_heights.h"
#include "tools/bake/city/ground_options.h"
#include "tools/bake/city/tile_grid.h"
#include "tools/mesh/triangle_mesh.h"
#include "tools/terrain/ground_points.h"
#include "tools/terrain/terrain.h"

namespace nightcity::bake {

/// A regular grid of heights, two triangles a square, thinned by GroundOptions::max_error_m.
/// Neighbouring tiles have the same vertices along their common side.
class GridGround {
 public:
  /// `tiles`: how many will be made; the more, the coarser the grid. `heights` must outlive it.
  GridGround(const GroundHeights& heights, const GroundOptions& options, std::size_t tiles);

  /// Returns a tile's ground; nothing where data are missing in it, which makes it one of
  /// tiles_with_gaps().
  std::optional<mesh::TriangleMesh> make_whole(const Tile& tile);
  const std::vector<Tile>& tiles_with_gaps() const { return with_gaps_; }

  /// Call when all whole tiles are made. Has the ground go on where data are missing: through the
  /// edges of the data and those of the buildings' `feet` that lie outside them.
  void fill_gaps(std::span<const glm::dvec3> feet);
  bool is_filled() const { return filling_.has_value(); }

  /// Returns the ground of a tile with gaps, without the squares that still lack a height.
  mesh::TriangleMesh make_filled(const Tile& tile);

  /// Returns the vertices of a tile's grid; their heights are NaN where data are missing.
  std::vector<glm::dvec3> find_heights(const Tile& tile) const;

  double step_m() const { return step_m_; }
  bool covers_nothing() const { return missing_ == squares_; }
  /// Returns the share of the squares for which the models have no data.
  double missing_percent() const {
    return 100.0 * static_cast<double>(missing_) / static_cast<double>(squares_);
  }
  /// Returns how many triangles fewer there are for thinning.
  std::size_t thinned() const { return thinned_; }

 private:
  std::vector<glm::dvec2> find_places(const Tile& tile) const;
  /// Visits the corners of each square as indices into its tile's places, counterclockwise.
  template <class Visit>
  void for_each_square(const Visit& visit) const;
  void note_gaps(const Tile& tile, std::span<const glm::dvec2> places, std::span<const double> z);
  std::vector<bool> straighten_sides(std::vector<double>& z) const;
  mesh::TriangleMesh make_mesh(std::span<const glm::dvec2> places, std::vector<double> z);

  const GroundHeights& heights_;
  double max_error_m_, tile_m_;
  double step_m_ = 0;
  std::uint32_t steps_ = 1;  // squares along a tile's side
  std::size_t squares_ = 0, missing_ = 0;
  std::size_t thinned_ = 0;  // triangles
  std::vector<Tile> with_gaps_;
  terrain::GroundPoints edges_;              // of the data
  std::optional<terrain::Terrain> filling_;  // a surface over the gaps
};

}  // namespace nightcity::bake
