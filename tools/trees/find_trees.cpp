#include "tools/trees/find_trees.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "formats/finite.h"
#include "tools/ground_cover/way_line.h"
#include "tools/osm/tag_values.h"
#include "tools/random.h"

namespace nightcity::trees {
namespace {

using ground_cover::tag_of;

constexpr double usual_height_m = 10, usual_needle_height_m = 14, crown_of_height = 0.6;
constexpr double min_distance_m = 4;  // of trees that the map does not show one by one

std::optional<double> length_of(const osm::OsmTags& tags, const char* key, double low,
                                double high) {
  const auto found = tags.find(key);
  if (found == tags.end()) return std::nullopt;
  const auto length = osm::parse_length_m(found->second);
  return length && *length >= low && *length <= high ? length : std::nullopt;
}

class Planter {
 public:
  Planter(const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
          const place::InsideBuilding& inside)
      : to_frame_(to_frame), height_at_(height_at), inside_(inside) {}

  void add_mapped(const osm::OsmPoint& tree) {
    plant(to_frame_(tree.lon_lat), tree.tags, "mapped", 0);
  }

  void add_row(const osm::OsmWay& row) {
    std::vector<glm::dvec2> line;
    for (const glm::dvec2& p : row.lon_lat)
      if (const glm::dvec2 place = to_frame_(p); finite(place)) line.push_back(place);
    double next_m = row_spacing_m / 2;  // to the next tree
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double length = glm::distance(line[i], line[i + 1]);
      // A hostile row may be as long as the world.
      for (; next_m <= length && !is_full(); next_m += row_spacing_m)
        plant(glm::mix(line[i], line[i + 1], next_m / length), row.tags, "in rows", min_distance_m);
      next_m -= length;
      if (is_full()) {
        ++set_.left_out["row of trees beyond the first 200000"];
        break;
      }
    }
  }

  // Strews trees over the squares of a grid, one in each.
  void add_wood(const ground_cover::Cover& cover, const ground_cover::CoverArea& wood,
                const ground_cover::Box& bounds) {
    if (is_full()) {
      ++set_.left_out["wood without trees: beyond the first 200000"];
      return;
    }
    ground_cover::Box box = ground_cover::find_box(wood.rings);
    box = {glm::max(box.low, bounds.low), glm::min(box.high, bounds.high)};
    const auto to_square = [](double v) {
      return static_cast<std::int64_t>(std::floor(v / wood_spacing_m));
    };
    for (std::int64_t i = to_square(box.low.x); i <= to_square(box.high.x); ++i)
      for (std::int64_t j = to_square(box.low.y); j <= to_square(box.high.y) && !is_full(); ++j) {
        Random random{i, j};
        const glm::dvec2 p =
            glm::dvec2(i + random.uniform(), j + random.uniform()) * wood_spacing_m;
        if (!mesh::holds(wood.rings, p)) continue;
        const ground_cover::Surface* surface = cover.surface_at(p);
        if (surface && surface->kind == ground_cover::GroundKind::woodland)
          plant(p, {}, "in woods", min_distance_m);
      }
  }

  TreeSet take() { return std::move(set_); }

 private:
  bool is_full() const { return set_.trees.size() >= max_trees || tried_ > 20 * max_trees; }

  void plant(const glm::dvec2& place, const osm::OsmTags& tags, const char* source,
             double distance_m) {
    ++tried_;
    if (!finite(place)) return;
    if (is_full()) {
      ++set_.left_out["tree beyond the first 200000"];
      return;
    }
    if (distance_m > 0 && has_neighbour(place, distance_m)) return;  // the map shows it already
    const auto height = height_at_(place);
    if (!height) {
      ++set_.left_out["tree beyond the ground"];
      return;
    }
    if (inside_ && inside_(place)) {
      ++set_.left_out["tree in a building or below a bridge"];
      return;
    }
    Tree tree = make_tree(tags, place);
    tree.foot = {place, *height};
    set_.trees.push_back(tree);
    ++set_.sources[source];
    squares_[square_of(place)].push_back(place);
  }

  // Trees without tags differ by up to a fifth, by their place.
  Tree make_tree(const osm::OsmTags& tags, const glm::dvec2& place) {
    Tree tree;
    const bool needles = tag_of(tags, "leaf_type") == "needleleaved";
    const std::string cycle = tag_of(tags, "leaf_cycle");
    tree.evergreen = cycle == "evergreen" || (needles && cycle.empty());
    auto height = length_of(tags, "height", 1, 100),
         crown = length_of(tags, "diameter_crown", 0.5, 40);
    if (!height && !crown) ++set_.assumed_sizes;
    if (!height && crown) height = std::max(*crown / crown_of_height, 2.0);
    if (!height) {
      Random random{std::llround(place.x * 100), std::llround(place.y * 100)};
      height = (needles ? usual_needle_height_m : usual_height_m) * random.range(0.8, 1.2);
    }
    tree.height_m = *height;
    tree.crown_m = crown.value_or(crown_of_height * tree.height_m);
    // Crowns are kept clear of people; the lowest branches of a high tree are higher.
    tree.clear_m = std::min(std::max(2.5, 0.25 * tree.height_m), 0.5 * tree.height_m);
    return tree;
  }

  using Square = std::pair<std::int64_t, std::int64_t>;
  static Square square_of(const glm::dvec2& p) {
    return {static_cast<std::int64_t>(std::floor(p.x / min_distance_m)),
            static_cast<std::int64_t>(std::floor(p.y / min_distance_m))};
  }
  bool has_neighbour(const glm::dvec2& place, double distance_m) const {
    const auto [i, j] = square_of(place);
    for (std::int64_t column = i - 1; column <= i + 1; ++column)
      for (std::int64_t row = j - 1; row <= j + 1; ++row)
        if (const auto found = squares_.find({column, row}); found != squares_.end())
          for (const glm::dvec2& p : found->second)
            if (glm::distance(p, place) < distance_m) return true;
    return false;
  }

  const place::LonLatToFrame& to_frame_;
  const place::HeightAt& height_at_;
  const place::InsideBuilding& inside_;
  TreeSet set_;
  std::size_t tried_ = 0;
  std::map<Square, std::vector<glm::dvec2>> squares_;
};

}  // namespace

TreeSet find_trees(const osm::OsmData& map, const ground_cover::Cover& cover,
                   const ground_cover::Box& bounds, const place::LonLatToFrame& to_frame,
                   const place::HeightAt& height_at, const place::InsideBuilding& inside) {
  Planter planter(to_frame, height_at, inside);
  for (const osm::OsmPoint& tree : map.trees) planter.add_mapped(tree);
  for (const osm::OsmWay& row : map.tree_rows) planter.add_row(row);
  for (const ground_cover::CoverArea& area : cover.areas())
    if (area.surface.kind == ground_cover::GroundKind::woodland)
      planter.add_wood(cover, area, bounds);
  return planter.take();
}

}  // namespace nightcity::trees
