#include "tools/bake/scene/deck_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "tools/bake/scene/drape.h"
#include "tools/mesh/partition.h"

namespace nightcity::bake {
namespace {

using bridges::BridgeDecks;
using bridges::Deck;

// Between places as near to each other as this a crest of 250 m is straight within a centimetre.
constexpr double max_deck_edge_m = 4;

bool meet(const ground_cover::Box& a, const ground_cover::Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

// Returns the decks of a layer in groups whose boxes meet, which one surface is made of.
std::vector<std::vector<const Deck*>> find_groups(const BridgeDecks& decks, int layer) {
  std::vector<std::vector<const Deck*>> groups;
  for (const Deck& deck : decks.decks()) {
    if (deck.layer != layer) continue;
    std::vector<const Deck*> joined{&deck};
    std::erase_if(groups, [&](const std::vector<const Deck*>& group) {
      const bool meets = std::any_of(group.begin(), group.end(),
                                     [&](const Deck* other) { return meet(deck.box, other->box); });
      if (meets) joined.insert(joined.end(), group.begin(), group.end());
      return meets;
    });
    groups.push_back(std::move(joined));
  }
  return groups;
}

class SurfaceMaker {
 public:
  SurfaceMaker(const BridgeDecks& decks, int layer, std::span<const Deck* const> group)
      : decks_(decks), layer_(layer), group_(group) {}

  DeckSurface make() {
    const glm::dvec2 origin = group_.front()->line.front();
    mesh::PlaneLayer outlines;
    for (const Deck* deck : group_) {
      outlines.push_back({deck->outline, 0});
      for (ground_cover::Ring& ring : outlines.back().rings)
        for (glm::dvec2& p : ring) p -= origin;
    }
    const mesh::PlanePartition plan = mesh::partition({{outlines}});
    for (const mesh::PlanePartition::Triangle& triangle : plan.triangles) {
      if (plan.owners[triangle.region][0] == mesh::no_label) continue;
      glm::dvec3 corners[3];
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::dvec3(plan.points[triangle.vertex[k]] + origin, 0);
      subdivide(corners, max_deck_edge_m, [&](const glm::dvec3(&piece)[3]) {
        surface_.triangles.push_back({number(piece[0]), number(piece[1]), number(piece[2])});
      });
    }
    find_edges();
    return std::move(surface_);
  }

 private:
  std::uint32_t number(const glm::dvec3& corner) {
    const auto [known, is_new] = numbers_.try_emplace(
        std::pair(corner.x, corner.y), static_cast<std::uint32_t>(surface_.points.size()));
    if (is_new) {
      const glm::dvec2 place(corner);
      surface_.points.emplace_back(place, decks_.height_at(layer_, place).value_or(0));
    }
    return known->second;
  }

  void find_edges() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& t : surface_.triangles)
      for (std::size_t k = 0; k < 3; ++k) edges.emplace(t[k], t[(k + 1) % 3]);
    for (const auto& [a, b] : edges)
      if (!edges.contains({b, a})) surface_.edges.push_back({a, b, lies_at_end(a, b)});
  }

  bool lies_at_end(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec2 middle = glm::dvec2(surface_.points[a] + surface_.points[b]) / 2.0;
    return std::any_of(group_.begin(), group_.end(), [&](const Deck* deck) {
      constexpr double slack_m = 1e-3;
      const Deck::Foot foot = deck->project(middle);
      return foot.away_m <= deck->half_m &&
             (foot.at_m < slack_m || foot.at_m > deck->length_m() - slack_m);
    });
  }

  const BridgeDecks& decks_;
  int layer_;
  std::span<const Deck* const> group_;
  std::map<std::pair<double, double>, std::uint32_t> numbers_;
  DeckSurface surface_;
};

}  // namespace

std::vector<DeckSurface> make_deck_surfaces(const BridgeDecks& decks, int layer) {
  std::vector<DeckSurface> surfaces;
  for (const auto& group : find_groups(decks, layer))
    surfaces.push_back(SurfaceMaker(decks, layer, group).make());
  return surfaces;
}

}  // namespace nightcity::bake
