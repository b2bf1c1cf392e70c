// The walls of the whole city, to find windows with something right in front of them.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tools/cell_cache.h"
#include "tools/cell_file.h"
#include "tools/city/city_model.h"

namespace nightcity::lights {

/// Keeps the walls on disk, in cells, so that memory does not grow with the city.
class WallIndex {
 public:
  /// Keeps a scratch file beside `scratch`.
  explicit WallIndex(const std::filesystem::path& scratch);
  ~WallIndex();
  WallIndex(WallIndex&&) noexcept;

  struct UprightWall {
    glm::dvec2 from{0}, to{0};  // plan, E, N, m
    double low = 0, high = 0;
    glm::dvec2 normal{0};  // outwards
  };
  /// Returns the upright surfaces of any object; E, N, H in metres.
  static std::vector<UprightWall> find_upright_walls(const city::CityObject& object);
  /// Adds walls of the object with the number `owner`.
  void add(std::span<const UprightWall> walls, std::uint32_t owner);

  /// Returns the column and row of the cell in which a place lies. Cells are read from the disk as
  /// a whole: ask for the places of one after the other.
  std::pair<std::int32_t, std::int32_t> find_cell(const glm::dvec3& p) const;

  /// Returns whether a wall crosses the horizontal line along `normal` from 5 cm behind one of the
  /// points to `reach_m` in front of it, at its height. The owner's walls that face the same way
  /// are the window's own facade and do not count; a party wall faces the other way and counts.
  /// This and inside_another() may be called from many threads once all walls are added.
  bool blocked(std::span<const glm::dvec3> points, const glm::dvec3& normal, double reach_m,
               std::uint32_t owner);

  /// Returns whether `p` lies inside an object other than its owner: both the ray along `normal`
  /// and the ray against it first hit the back of a wall of the same object. (A ray over a low eave
  /// onto a high back wall is only one of the two.) The rays are 30 m long.
  bool inside_another(const glm::dvec3& p, const glm::dvec3& normal, std::uint32_t owner);

 private:
  struct Wall {
    float ax, ay, bx, by;  // plan, relative to origin_
    float low, high;
    float east, north;  // of the outward normal in plan, of length 1
    std::uint32_t owner;
  };
  struct CellKey {
    std::int32_t column, row;
    auto operator<=>(const CellKey&) const = default;
  };
  struct Loaded;
  struct Line;
  /// Calls visit(cell, n) for the n-th wall of a cell, for all in the buckets of a rectangle, until
  /// it returns true, and returns whether it did; for some walls more than once. Of walls in one
  /// place, which is one square centimetre where over a thousand walls are near, it is called for
  /// those of two owners.
  template <class Visit>
  bool any_in_buckets(const glm::dvec2& low, const glm::dvec2& high, const Visit& visit);
  /// Calls visit(cell, n, t, same_way) for walls that cross the line, at t in [0, 1] along it, as
  /// any_in_buckets() does. `same_way`: cosine of the angle between the wall's normal and the line.
  template <class Visit>
  bool any_crossing(double height, const glm::dvec2& from, const glm::dvec2& line,
                    const Visit& visit);

  std::optional<glm::dvec3> origin_;
  CellFile<CellKey, Wall> cells_;
  std::unique_ptr<CellCache<CellKey, Loaded>> cache_;
};

}  // namespace nightcity::lights
