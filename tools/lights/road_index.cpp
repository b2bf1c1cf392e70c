#include "tools/lights/road_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "tools/roads/carriageway.h"

namespace nightcity::lights {
namespace {

constexpr double cell_m =
    nearest_road_m;  // so that a lamp's road lies in its cell or a neighbouring one
constexpr double path_handicap_m = 6;
constexpr double longest_m = 1e5;  // a longer jump between two nodes is a broken extract

std::uint64_t cell_key(std::int64_t x, std::int64_t y) {
  return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
}

std::int64_t cell_of(double coordinate) {
  return static_cast<std::int64_t>(std::floor(coordinate / cell_m));
}

}  // namespace

bool RoadIndex::comes_first(const Piece& a, const Piece& b) const {
  const auto key = [&](const Piece& piece) {
    const Road& road = roads_[piece.road];
    return std::tuple(static_cast<int>(road.lighting->tier), -road.lighting->flux_lm, -road.width_m,
                      piece.a.x, piece.a.y, piece.b.x, piece.b.y);
  };
  return key(a) < key(b);
}

void RoadIndex::add(const osm::OsmWay& way, const std::vector<glm::dvec2>& line) {
  const auto carriageway = roads::read_carriageway(way.tags);
  if (!carriageway) return;
  const auto number = static_cast<std::uint32_t>(roads_.size());
  roads_.push_back({&find_road_lighting(*carriageway->road_class), carriageway->width_m, way.id});

  double along = 0;
  for (std::size_t n = 0; n + 1 < line.size(); ++n) {
    const double length = glm::distance(line[n], line[n + 1]);
    if (!(length > 0 && length < longest_m)) continue;
    const int parts = static_cast<int>(std::ceil(length / cell_m));
    for (int part = 0; part < parts; ++part) {
      const Piece piece{glm::mix(line[n], line[n + 1], static_cast<double>(part) / parts),
                        glm::mix(line[n], line[n + 1], static_cast<double>(part + 1) / parts),
                        number, along + length * part / parts};
      const auto index = static_cast<std::uint32_t>(pieces_.size());
      pieces_.push_back(piece);
      const glm::dvec2 low = glm::min(piece.a, piece.b), high = glm::max(piece.a, piece.b);
      for (std::int64_t x = cell_of(low.x); x <= cell_of(high.x); ++x)
        for (std::int64_t y = cell_of(low.y); y <= cell_of(high.y); ++y)
          cells_[cell_key(x, y)].push_back(index);
    }
    along += length;
  }
}

std::optional<RoadIndex::Nearest> RoadIndex::nearest(const glm::dvec2& p) const {
  std::optional<Nearest> best;
  const Piece* best_piece = nullptr;
  double best_score = std::numeric_limits<double>::infinity();
  for (std::int64_t x = cell_of(p.x) - 1; x <= cell_of(p.x) + 1; ++x)
    for (std::int64_t y = cell_of(p.y) - 1; y <= cell_of(p.y) + 1; ++y) {
      const auto cell = cells_.find(cell_key(x, y));
      if (cell == cells_.end()) continue;
      for (const std::uint32_t index : cell->second) {
        const Piece& piece = pieces_[index];
        const Road& road = roads_[piece.road];
        const glm::dvec2 edge = piece.b - piece.a;
        const double t = glm::clamp(glm::dot(p - piece.a, edge) / glm::dot(edge, edge), 0.0, 1.0);
        const glm::dvec2 point = piece.a + edge * t;
        const double distance = glm::distance(p, point);
        if (distance > nearest_road_m) continue;
        const double score = distance - road.width_m / 2 +
                             (road.lighting->tier == roads::RoadTier::path ? path_handicap_m : 0);
        // Two ways are equally near at a node that they share.
        if (score > best_score || (score == best_score && !comes_first(piece, *best_piece)))
          continue;
        best_score = score;
        best_piece = &piece;
        best = Nearest{&road, point, glm::normalize(edge), distance,
                       piece.from_m + t * glm::length(edge)};
      }
    }
  return best;
}

}  // namespace nightcity::lights
