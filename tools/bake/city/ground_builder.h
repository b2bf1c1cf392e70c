// The ground of a city: its own relief, else elevation models, else a surface through the
// buildings' footprints. Where one ends within the city, the next goes on.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tools/bake/city/city_consumer.h"
#include "tools/bake/city/ground_options.h"
#include "tools/bake/city/tile_grid.h"
#include "tools/bake/report/city_report.h"
#include "tools/georeference/frame.h"
#include "tools/terrain/outline.h"
#include "tools/terrain/terrain.h"

namespace nightcity::bake {

/// Gathers the surfaces of the terrain while the city is read, then builds the ground.
class GroundBuilder final : public CityConsumer {
 public:
  /// Fills `terrain`, which must outlive the builder.
  GroundBuilder(terrain::Terrain& terrain, GroundOptions options)
      : terrain_(terrain), options_(std::move(options)) {}

  Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override;

  /// Has the ground reach for these places of the map, by GroundOptions::map_reach_m.
  void reach_for(std::vector<glm::dvec2> places) { places_ = std::move(places); }

  /// Gets the ground's triangles that are to be seen and belong to no object. E, N, H in metres.
  using ShowGround = std::function<void(const mesh::TriangleMesh&)>;

  /// Builds the terrain; call when every object has been read. Throws Error where an elevation
  /// model cannot be read or covers nothing of the city.
  GroundReport build(const georeference::CityFrame& frame, const ShowGround& show = {});

  /// Returns the edge of the ground that is shown: of the terrain, and of what may lie in it in its
  /// place, roads and water. Empty where none is shown, and without GroundOptions::keeps_outline.
  const terrain::Outline& outline() const { return outline_; }

 private:
  std::string build_dem_ground(const georeference::CityFrame& frame, const ShowGround& show);
  void go_beyond_relief(const georeference::CityFrame& frame, std::span<const glm::dvec3> feet,
                        const ShowGround& show);
  std::string add_heights(const georeference::CityFrame& frame, std::span<const glm::dvec3> feet,
                          const std::function<bool(const glm::dvec3&)>& has_ground,
                          std::vector<glm::dvec3>& beyond) const;
  bool needs_outline() const { return options_.keeps_outline || options_.make_surface; }

  terrain::Terrain& terrain_;
  GroundOptions options_;
  std::set<Tile> occupied_;         // tiles that hold some of the city
  std::vector<glm::dvec2> places_;  // of the map
  terrain::Outline outline_;
  GroundReport report_;
};

}  // namespace nightcity::bake
