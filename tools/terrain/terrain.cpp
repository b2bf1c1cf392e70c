#include "tools/terrain/terrain.h"

#include <array>
#include <cstddef>
#include <utility>

#include "formats/free_memory.h"
#include "tools/terrain/ground_points.h"
#include "tools/terrain/made_surface.h"
#include "tools/terrain/thin_surface.h"

namespace nightcity::terrain {
namespace {

constexpr std::size_t max_line_vertices = 200'000;

}  // namespace

struct Terrain::State {
  explicit State(const std::filesystem::path& scratch)
      : layers{SurfaceStore(scratch), SurfaceStore(scratch), SurfaceStore(scratch),
               SurfaceStore(scratch)} {}

  SurfaceStore& layer(SurfaceClass surface_class) {
    return layers[static_cast<std::size_t>(surface_class)];
  }

  std::array<SurfaceStore, 4> layers;
  GroundPoints relief_points, ground_points, road_points;
  std::vector<std::vector<glm::dvec3>> break_lines;
  std::size_t line_vertices = 0;
  BreakEdges break_edges;
  mesh::TriangleMesh made;
};

Terrain::Terrain(const std::filesystem::path& scratch) : state_(std::make_unique<State>(scratch)) {}
Terrain::~Terrain() = default;
Terrain::Terrain(Terrain&&) noexcept = default;
Terrain& Terrain::operator=(Terrain&&) noexcept = default;

void Terrain::add(const mesh::TriangleMesh& mesh, SurfaceClass surface_class) {
  SurfaceStore& layer = state_->layer(surface_class);
  // Points for a surface where the model gives none.
  GroundPoints* const points = surface_class == SurfaceClass::ground_surface
                                   ? &state_->ground_points
                               : surface_class == SurfaceClass::road ? &state_->road_points
                                                                     : nullptr;
  for (const mesh::MeshTriangle& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t k) -> const glm::dvec3& {
      return mesh.positions[triangle.vertex[k]];
    };
    if (!layer.add(corner(0), corner(1), corner(2)) || !points) continue;
    for (std::size_t k = 0; k < 3; ++k) points->add(corner(k));
  }
}

void Terrain::add_points(std::span<const glm::dvec3> points) {
  for (const glm::dvec3& p : points) state_->relief_points.add(p);
}

bool Terrain::add_break_line(const std::vector<glm::dvec3>& line) {
  if (state_->line_vertices + line.size() > max_line_vertices) {
    add_points(line);
    return false;
  }
  state_->line_vertices += line.size();
  state_->break_lines.push_back(line);
  return true;
}

bool Terrain::has_relief() const {
  return !state_->layer(SurfaceClass::terrain).empty() || !state_->relief_points.empty() ||
         !state_->break_lines.empty();
}

std::optional<Extent> Terrain::extent() const {
  return state_->layer(SurfaceClass::terrain).extent();
}

Terrain::BreakEdges Terrain::break_edges() const {
  return state_->break_edges;
}

const std::vector<glm::dvec3>& Terrain::footprint_points() const {
  return (state_->ground_points.empty() ? state_->road_points : state_->ground_points).points();
}

void Terrain::build(double margin_m, double max_error_m, const std::optional<Extent>& reach) {
  State& state = *state_;
  if (state.layer(SurfaceClass::terrain).empty()) {
    if (!state.break_lines.empty()) {
      BreakSurface surface = make_surface(state.relief_points.take(), state.break_lines, margin_m);
      state.break_edges = {surface.edges, surface.unused_edges};
      state.made = std::move(surface.mesh);
    } else {
      GroundPoints& from = !state.relief_points.empty()   ? state.relief_points
                           : !state.ground_points.empty() ? state.ground_points
                                                          : state.road_points;
      state.made = make_surface(from.take(), margin_m, reach);
    }
    if (max_error_m > 0) state.made = thin_surface(state.made, max_error_m);
    add(state.made, SurfaceClass::terrain);
  }
  free_memory(state.break_lines);
  for (GroundPoints* points : {&state.relief_points, &state.ground_points, &state.road_points})
    points->take();
}

std::optional<Terrain::Hit> Terrain::height_at(const glm::dvec2& east_north) const {
  for (std::size_t n = 0; n < state_->layers.size(); ++n)
    if (const auto height = height_of(static_cast<SurfaceClass>(n), east_north))
      return Hit{*height, static_cast<SurfaceClass>(n)};
  return std::nullopt;
}

std::optional<double> Terrain::height_of(SurfaceClass surface_class,
                                         const glm::dvec2& east_north) const {
  return state_->layer(surface_class).highest_at(east_north);
}

bool Terrain::inside_building(const glm::dvec2& east_north) const {
  return height_of(SurfaceClass::ground_surface, east_north) ||
         height_of(SurfaceClass::roof, east_north);
}

const mesh::TriangleMesh& Terrain::made_surface() const {
  return state_->made;
}

void Terrain::drop_made_surface() {
  state_->made = {};
}

}  // namespace nightcity::terrain
