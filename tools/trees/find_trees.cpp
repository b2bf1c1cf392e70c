#include "tools/trees/find_trees.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <utility>

#include "formats/finite.h"
#include "tools/osm/tag_values.h"
#include "tools/place/place_grid.h"
#include "tools/random.h"
#include "tools/trees/tree_tags.h"

namespace nightcity::trees {
namespace {

constexpr double usual_height_m = 10, usual_needle_height_m = 14, crown_of_height = 0.6;
constexpr double min_distance_m = 4;  // of trees that the map does not show one by one

// Trees of unknown size differ by up to a fifth, by their place.
Tree complete(const KnownSize& known, const glm::dvec2& place) {
  Tree tree;
  tree.evergreen = known.habit.evergreen;
  auto height = known.height_m;
  if (!height && known.crown_m) height = std::max(*known.crown_m / crown_of_height, 2.0);
  if (!height) {
    Random random{std::llround(place.x * 100), std::llround(place.y * 100)};
    height =
        (known.habit.needles ? usual_needle_height_m : usual_height_m) * random.range(0.8, 1.2);
  }
  tree.height_m = *height;
  tree.crown_m = known.crown_m.value_or(crown_of_height * tree.height_m);
  tree.trunk_m = known.trunk_m.value_or(trunk_of_height * tree.height_m);
  // Crowns are kept clear of people; the lowest branches of a high tree are higher.
  tree.clear_m = known.is_shrub ? 0 : std::min(std::max(2.5, 0.25 * *height), 0.5 * *height);
  return tree;
}

bool has_nearer(const place::PlaceGrid& places, const glm::dvec2& place, double distance_m) {
  return places.any_near(place, distance_m, [&](const glm::dvec2& other, std::uint32_t) {
    return glm::distance(other, place) < distance_m;
  });
}

class Planter {
 public:
  Planter(const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
          const place::InsideBuilding& inside)
      : to_frame_(to_frame), height_at_(height_at), inside_(inside) {}

  // `number`: of the tree among those of the model.
  void add_of_model(const ModelTree& tree, std::uint32_t number) {
    if (!tree.outlines.empty()) return add_cover(tree, number);
    if (is_full()) {
      ++set_.left_out["tree beyond the first 200000"];
      return;
    }
    const auto foot = find_foot(tree);
    if (!foot) {
      ++set_.left_out["tree beyond the ground"];
      return;
    }
    set_.odd_sizes += static_cast<std::size_t>(tree.odd_sizes);
    Tree made = make_tree({tree.height_m, tree.crown_m, tree.trunk_m, tree.habit, tree.is_shrub},
                          tree.place);
    made.of_model = number;
    add(made, {tree.place, *foot}, "of the model");
    of_model_.add(tree.place, 0);
  }

  void add_mapped(const osm::OsmPoint& tree) {
    plant(to_frame_(tree.lon_lat), read_tree_tags(tree.tags), "mapped", false);
  }

  void add_row(const osm::OsmWay& row) {
    std::vector<glm::dvec2> line;
    for (const glm::dvec2& p : row.lon_lat)
      if (const glm::dvec2 place = to_frame_(p); finite(place)) line.push_back(place);
    const KnownSize known = read_tree_tags(row.tags);
    double next_m = row_spacing_m / 2;  // to the next tree
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const double length = glm::distance(line[i], line[i + 1]);
      // A hostile row may be as long as the world.
      for (; next_m <= length && !is_full(); next_m += row_spacing_m)
        plant(glm::mix(line[i], line[i + 1], next_m / length), known, "in rows", true);
      next_m -= length;
      if (is_full()) {
        ++set_.left_out["row of trees beyond the first 200000"];
        break;
      }
    }
  }

  // Strews trees over a cover of plants of the model. They are as high as it in the mean.
  void add_cover(const ModelTree& cover, std::uint32_t number) {
    set_.odd_sizes += static_cast<std::size_t>(cover.odd_sizes);
    strew(ground_cover::find_box(cover.outlines), [&](const glm::dvec2& p, Random& random) {
      if (!mesh::holds(cover.outlines, p) || has_nearer(all_, p, min_distance_m) ||
          (inside_ && inside_(p)))
        return;
      const auto height = height_at_(p);
      const auto foot = height ? height : cover.foot_m;
      if (!foot) return;
      Tree tree = complete({*cover.height_m * random.range(0.8, 1.2), std::nullopt, std::nullopt,
                            cover.habit, false},
                           p);
      tree.of_model = number;
      add(tree, {p, *foot}, "in covers of the model");
      of_model_.add(p, 0);
    });
    if (is_full()) ++set_.left_out["cover of plants beyond the first 200000 trees"];
  }

  void add_wood(const ground_cover::Cover& cover, const ground_cover::CoverArea& wood,
                const ground_cover::Box& bounds) {
    if (is_full()) {
      ++set_.left_out["wood without trees: beyond the first 200000"];
      return;
    }
    ground_cover::Box box = ground_cover::find_box(wood.rings);
    box = {glm::max(box.low, bounds.low), glm::min(box.high, bounds.high)};
    const osm::OsmTags none;
    const osm::OsmTags& tags = wood.tags ? *wood.tags : none;
    const bool is_mixed = osm::find_tag(tags, "leaf_type") == "mixed";
    KnownSize known = read_tree_tags(tags);
    known.crown_m.reset();
    const auto mean_m = known.height_m;
    strew(box, [&](const glm::dvec2& p, Random& random) {
      if (!mesh::holds(wood.rings, p)) return;
      const ground_cover::Surface* surface = cover.surface_at(p);
      if (!surface || surface->kind != ground_cover::GroundKind::woodland) return;
      // Trees are as high as the wood in the mean, and half of a mixed one have needles.
      if (mean_m) known.height_m = *mean_m * random.range(0.8, 1.2);
      if (is_mixed && random.uniform() < 0.5)
        known.habit = {true, true};
      else if (is_mixed)
        known.habit = {false, false};
      plant(p, known, "in woods", true);
    });
  }

  TreeSet take() { return std::move(set_); }

 private:
  // Passes a place in each square of a grid that meets the box, and the random numbers that made it.
  template <class Visit>
  void strew(const ground_cover::Box& box, const Visit& visit) {
    const auto to_square = [](double v) {
      return static_cast<std::int64_t>(std::floor(v / wood_spacing_m));
    };
    for (std::int64_t i = to_square(box.low.x); i <= to_square(box.high.x); ++i)
      for (std::int64_t j = to_square(box.low.y); j <= to_square(box.high.y) && !is_full(); ++j) {
        Random random{i, j};
        const glm::dvec2 p = glm::dvec2(static_cast<double>(i) + random.uniform(),
                                        static_cast<double>(j) + random.uniform()) *
                             wood_spacing_m;
        visit(p, random);
      }
  }

  bool is_full() const { return set_.trees.size() >= max_trees || tried_ > 20 * max_trees; }

  void plant(const glm::dvec2& place, const KnownSize& known, const char* source,
             bool keeps_distance) {
    ++tried_;
    if (!finite(place)) return;
    if (is_full()) {
      ++set_.left_out["tree beyond the first 200000"];
      return;
    }
    if (has_nearer(of_model_, place, same_tree_m)) {
      ++set_.left_out["tree of the map that the model has"];
      return;
    }
    if (keeps_distance && has_nearer(all_, place, min_distance_m))
      return;  // the map shows it already
    const auto height = height_at_(place);
    if (!height) {
      ++set_.left_out["tree beyond the ground"];
      return;
    }
    if (inside_ && inside_(place)) {
      ++set_.left_out["tree in a building or below a bridge"];
      return;
    }
    add(make_tree(known, place), {place, *height}, source);
  }

  void add(Tree tree, const glm::dvec3& foot, const char* source) {
    tree.foot = foot;
    set_.trees.push_back(tree);
    ++set_.sources[source];
    all_.add(glm::dvec2(foot), 0);
  }

  // The height of a model's tree: the ground's where the two agree or the model has none.
  std::optional<double> find_foot(const ModelTree& tree) const {
    const auto ground = height_at_(tree.place);
    if (!tree.foot_m) return ground;
    return ground && std::abs(*ground - *tree.foot_m) <= max_lift_m ? ground : tree.foot_m;
  }

  Tree make_tree(const KnownSize& known, const glm::dvec2& place) {
    if (!known.height_m && !known.crown_m) ++set_.assumed_sizes;
    return complete(known, place);
  }

  const place::LonLatToFrame& to_frame_;
  const place::HeightAt& height_at_;
  const place::InsideBuilding& inside_;
  TreeSet set_;
  std::size_t tried_ = 0;
  place::PlaceGrid all_{min_distance_m}, of_model_{same_tree_m};
};

}  // namespace

TreeSet find_trees(const osm::OsmData& map, const ground_cover::Cover& cover,
                   const ground_cover::Box& bounds, const place::LonLatToFrame& to_frame,
                   const place::HeightAt& height_at, const place::InsideBuilding& inside,
                   std::span<const ModelTree> model) {
  Planter planter(to_frame, height_at, inside);
  for (std::uint32_t i = 0; i < model.size(); ++i) planter.add_of_model(model[i], i);
  for (const osm::OsmPoint& tree : map.trees) planter.add_mapped(tree);
  for (const osm::OsmWay& row : map.tree_rows) planter.add_row(row);
  for (const ground_cover::CoverArea& area : cover.areas())
    if (area.surface.kind == ground_cover::GroundKind::woodland)
      planter.add_wood(cover, area, bounds);
  return planter.take();
}

}  // namespace nightcity::trees
