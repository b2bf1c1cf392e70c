// Walls of the whole city, for one question: does something stand right before this window?
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
#include <vector>

#include "tools/cell_cache.h"
#include "tools/cell_file.h"
#include "tools/city/city_model.h"

namespace nightcity {

/// Walls lie on disk, in cells, so that memory does not grow with the city.
class WallIndex {
 public:
  /// Scratch file beside `scratch`.
  explicit WallIndex(const std::filesystem::path& scratch);
  ~WallIndex();
  WallIndex(WallIndex&&) noexcept;

  struct Upright {
    glm::dvec2 from{0}, to{0};  // plan, E, N, m
    double low = 0, high = 0;
    glm::dvec2 normal{0};  // outwards
  };
  /// Upright surfaces of any object, E, N, H in metres.
  static std::vector<Upright> upright_walls(const CityObject& object);
  /// `owner` tells objects apart.
  void add(std::span<const Upright> walls, std::uint32_t owner);

  /// Whether a wall crosses the horizontal line from 5 cm behind `p` to `reach_m` before it along `normal`,
  /// at p's height. The owner's walls that face the same way are the window's own facade and do not count; a
  /// party wall faces the other way and does. This and inside_another() are safe to ask from many threads
  /// once nothing is added any more.
  bool blocked(const glm::dvec3& p, const glm::dvec3& normal, double reach_m, std::uint32_t owner);

  /// Whether `p` lies inside an object that is not its owner's: whoever walks from it along `normal` comes to
  /// the back of a wall first, and backwards to the back of another wall of the same object (a look over a
  /// low eave onto a high back wall meets only the first). Looks 30 m either way.
  bool inside_another(const glm::dvec3& p, const glm::dvec3& normal, std::uint32_t owner);

 private:
  struct Wall {
    float ax, ay, bx, by;  // plan, relative to origin_
    float low, high;
    float facing;  // angle of the outward normal
    std::uint32_t owner;
  };
  struct CellKey {
    std::int32_t column, row;
    auto operator<=>(const CellKey&) const = default;
  };
  struct Loaded;
  /// Calls visit(wall, t, same_way) for every wall that crosses the line, t in [0, 1] along it; for some more
  /// than once.
  template <class Visit>
  void crossings(const glm::dvec3& local, const glm::dvec2& from, const glm::dvec2& line,
                 const Visit& visit);

  std::optional<glm::dvec3> origin_;
  CellFile<CellKey, Wall> cells_;
  std::unique_ptr<CellCache<CellKey, Loaded>> cache_;
};

}  // namespace nightcity
