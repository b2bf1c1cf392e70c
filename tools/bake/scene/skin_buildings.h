// Gives walls and roofs of buildings their finish, where neither model nor map says a colour.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "tools/bake/city/city_consumer.h"
#include "tools/bake/report/skin_report.h"
#include "tools/bake/scene/skins.h"
#include "tools/bake/scene/tile_store.h"
#include "tools/lights/building_use.h"

namespace nightcity::bake {

class BuildingSkinner {
 public:
  /// `use_at`: what the map says of uses (make_use_finder).
  explicit BuildingSkinner(lights::UseAt use_at) : use_at_(std::move(use_at)) {}

  /// Returns the skin of a building. One without an id is told apart by its place. May be called
  /// from many threads.
  BuildingSkin find_skin(const PreparedObject& building) const;

  /// Gives the skin to those of the building's triangles that have no colour, and counts it.
  /// `continues`: the object is a further piece of the building before it, and looks like that.
  void apply(const BuildingSkin& skin, const city::CityObject& building, bool continues,
             std::span<TileStore::Triangle> triangles);

  const SkinReport& report() const { return report_; }

 private:
  lights::UseAt use_at_;
  BuildingSkin last_;
  SkinReport report_;
};

/// Returns the part of a building that a triangle with the plain material of walls or roofs belongs
/// to; none for other triangles. Roofs of up to 10 degrees are flat.
std::optional<SkinPart> find_skin_part(const TileStore::Triangle& triangle);

}  // namespace nightcity::bake
