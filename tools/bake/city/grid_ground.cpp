#include "tools/bake/city/grid_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

#include "tools/terrain/thin_surface.h"

namespace nightcity::bake {
namespace {

constexpr double max_squares = 1e6;

bool is_whole(std::span<const double> z) {
  return std::all_of(z.begin(), z.end(), [](double height) { return std::isfinite(height); });
}

}  // namespace

GridGround::GridGround(const GroundHeights& heights, const GroundOptions& options,
                       std::size_t tiles)
    : heights_(heights), max_error_m_(options.max_error_m), tile_m_(options.tile_m) {
  const double finest = std::ceil(tile_m_ / heights.finest_m()),
               affordable = std::floor(std::sqrt(max_squares / static_cast<double>(tiles)));
  steps_ = static_cast<std::uint32_t>(std::clamp(std::min(finest, affordable), 1.0, 512.0));
  step_m_ = tile_m_ / steps_;
}

std::vector<glm::dvec2> GridGround::find_places(const Tile& tile) const {
  std::vector<glm::dvec2> places;
  // Counted from the frame's origin, so that neighbouring tiles have the very same vertices.
  const auto line = [&](std::int32_t number, std::uint32_t i) {
    return static_cast<double>(std::int64_t{number} * steps_ + i) * step_m_;
  };
  for (std::uint32_t j = 0; j <= steps_; ++j)
    for (std::uint32_t i = 0; i <= steps_; ++i)
      places.emplace_back(line(tile.column, i), line(tile.row, j));
  return places;
}

std::vector<glm::dvec3> GridGround::find_heights(const Tile& tile) const {
  const std::vector<glm::dvec2> places = find_places(tile);
  const std::vector<double> z = heights_.at(places);
  std::vector<glm::dvec3> vertices;
  for (std::size_t i = 0; i < places.size(); ++i) vertices.emplace_back(places[i], z[i]);
  return vertices;
}

template <class Visit>
void GridGround::for_each_square(const Visit& visit) const {
  for (std::uint32_t j = 0; j < steps_; ++j)
    for (std::uint32_t i = 0; i < steps_; ++i) {
      const std::uint32_t a = j * (steps_ + 1) + i;
      visit(a, a + 1, a + steps_ + 2, a + steps_ + 1);
    }
}

std::optional<mesh::TriangleMesh> GridGround::make_whole(const Tile& tile) {
  const std::vector<glm::dvec2> places = find_places(tile);
  std::vector<double> z = heights_.at(places);
  squares_ += std::size_t{steps_} * steps_;
  if (is_whole(z)) return make_mesh(places, std::move(z));
  note_gaps(tile, places, z);
  return std::nullopt;
}

void GridGround::note_gaps(const Tile& tile, std::span<const glm::dvec2> places,
                           std::span<const double> z) {
  with_gaps_.push_back(tile);
  std::vector<bool> is_edge(z.size());
  for_each_square([&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (std::isfinite(z[a] + z[b] + z[c] + z[d])) return;
    ++missing_;
    for (const std::uint32_t corner : {a, b, c, d})
      if (std::isfinite(z[corner])) is_edge[corner] = true;
  });
  for (std::size_t i = 0; i < z.size(); ++i)
    if (is_edge[i]) edges_.add({places[i], z[i]});
}

void GridGround::fill_gaps(std::span<const glm::dvec3> feet) {
  if (with_gaps_.empty()) return;
  std::vector<glm::dvec3> points = edges_.take();
  const std::vector<double> known = heights_.at(std::vector<glm::dvec2>(feet.begin(), feet.end()));
  for (std::size_t i = 0; i < feet.size(); ++i)
    if (!std::isfinite(known[i])) points.push_back(feet[i]);
  constexpr double inf = std::numeric_limits<double>::infinity();
  terrain::Extent reach{glm::dvec2(inf), glm::dvec2(-inf)};
  for (const Tile& tile : with_gaps_) {
    const glm::dvec2 low = glm::dvec2(tile.column, tile.row) * tile_m_;
    reach = {glm::min(reach.low, low), glm::max(reach.high, low + tile_m_)};
  }
  filling_.emplace();
  filling_->add_points(points);
  filling_->build(step_m_, 0, reach);
  filling_->drop_made_surface();
}

mesh::TriangleMesh GridGround::make_filled(const Tile& tile) {
  const std::vector<glm::dvec2> places = find_places(tile);
  std::vector<double> z = heights_.at(places);
  if (filling_)
    for (std::size_t i = 0; i < z.size(); ++i)
      if (!std::isfinite(z[i]))
        if (const auto hit = filling_->height_at(places[i])) z[i] = hit->height_m;
  return make_mesh(places, std::move(z));
}

mesh::TriangleMesh GridGround::make_mesh(std::span<const glm::dvec2> places,
                                         std::vector<double> z) {
  const std::vector<bool> loose = straighten_sides(z);
  mesh::TriangleMesh mesh;
  for (std::size_t i = 0; i < places.size(); ++i) mesh.positions.emplace_back(places[i], z[i]);
  for_each_square([&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    if (!std::isfinite(z[a] + z[b] + z[c] + z[d])) return;
    mesh.triangles.push_back({{a, b, c}, city::SurfaceType::terrain, 0});
    mesh.triangles.push_back({{a, c, d}, city::SurfaceType::terrain, 0});
  });
  const std::size_t whole = mesh.triangles.size();
  // All vertices stay if data are missing: then the tile's outline does not follow its sides.
  if (max_error_m_ > 0 && is_whole(z)) mesh = terrain::thin_surface(mesh, max_error_m_, loose);
  thinned_ += whole - mesh.triangles.size();
  return mesh;
}

// Returns which vertices of the tile's sides are not needed, and puts them on the straight lines
// between the others: so a neighbour meets this tile whether it uses them or not.
std::vector<bool> GridGround::straighten_sides(std::vector<double>& z) const {
  std::vector<bool> loose(z.size());
  if (!(max_error_m_ > 0)) return loose;
  const std::size_t row = steps_ + 1, last = steps_;
  for (const auto& [first, stride] :
       {std::pair<std::size_t, std::size_t>{0, 1}, {last * row, 1}, {0, row}, {last, row}}) {
    std::vector<double> side;
    for (std::size_t n = 0; n < row; ++n) side.push_back(z[first + n * stride]);
    if (std::any_of(side.begin(), side.end(), [](double h) { return !std::isfinite(h); })) continue;
    const std::vector<bool> needed = terrain::find_needed(side, max_error_m_);
    for (std::size_t from = 0, to = 1; to < row; ++to) {
      if (!needed[to]) continue;
      for (std::size_t n = from + 1; n < to; ++n) {
        const double share = static_cast<double>(n - from) / static_cast<double>(to - from);
        z[first + n * stride] = side[from] + share * (side[to] - side[from]);
        loose[first + n * stride] = true;
      }
      from = to;
    }
  }
  return loose;
}

}  // namespace nightcity::bake
