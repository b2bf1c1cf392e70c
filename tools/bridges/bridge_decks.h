// The decks of a map's bridges: where they lie and how high, for all that is drawn on them, stands
// on them or drives on them. This is the one definition of these heights.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "tools/bridges/chains.h"
#include "tools/ground_cover/box_index.h"

namespace nightcity::bridges {

/// The deck that carries a chain, or the part of it above the model's ground.
struct Deck {
  Carried kind = Carried::street;
  int layer = 0;
  double half_m = 0;
  std::vector<glm::dvec2> line;   // E, N, m
  std::vector<double> at_m;       // of each point of the line, from its start
  std::vector<double> heights_m;  // of places that lie evenly along it, both ends among them
  /// Stretches at both ends in which the deck still lies in the ground, m.
  double in_ground_m[2] = {0, 0};
  std::vector<ground_cover::Ring> outline;  // flat at both ends
  ground_cover::Box box{};                  // of all that has a height here

  double length_m() const { return at_m.back(); }
  double height_at(double s) const;
  /// A place seen from the line: the nearest point's distance from its start and from the place.
  struct Foot {
    double at_m, away_m;
    glm::dvec2 point;
    bool is_beyond;  // the place lies beyond an end
  };
  Foot project(const glm::dvec2& place) const;
};

struct BridgeReport {
  struct Count {
    std::size_t bridges = 0;
    double length_m = 0;
  };
  std::map<std::string, Count> built;      // by what they carry
  std::map<std::string, Count> on_ground;  // by the reason why they have no deck
  std::size_t low = 0;  // built, but lower above what they cross than they should be
};

class BridgeDecks {
 public:
  /// A way's place on the deck that carries it.
  struct Lifted {
    std::size_t deck;
    double from_m;  // along the deck: of the way's first point
    bool reversed;  // the deck runs against the way
    bool is_guest;  // a track in a street: the deck is the street's
  };

  std::span<const Deck> decks() const { return decks_; }
  bool empty() const { return decks_.empty(); }
  const Lifted* find(std::int64_t way_id) const;

  /// Returns the height of the decks of a layer at a place, by which they are drawn: of a single
  /// one that of its line beside the place, of several that overlap a mean that has no steps. None
  /// beside them.
  std::optional<double> height_at(int layer, const glm::dvec2& place) const;
  /// Returns the place on the deck of a way for what stands at a place, or up to a metre beside the
  /// deck. None where the way lies on the ground there.
  std::optional<glm::dvec3> find_place(std::int64_t way_id, const glm::dvec2& place) const;
  /// Returns the height of the lowest soffit over a place (E, N, H); none in the open.
  std::optional<double> find_soffit(const glm::dvec3& place) const;
  /// Returns whether a place lies below a deck.
  bool covers(const glm::dvec2& place) const;

  const BridgeReport& report() const { return report_; }

 private:
  friend class DeckFinder;
  void add(Deck deck);

  std::vector<Deck> decks_;
  ground_cover::BoxIndex index_;
  std::unordered_map<std::int64_t, Lifted> lifted_;
  BridgeReport report_;
};

/// The ways of a map that may be bridges or pass below some.
struct BridgeMap {
  std::span<const osm::OsmWay> highways, railways;
};

/// Finds the decks of a map's bridges over a ground whose heights are `height_at`. The order of the
/// ways does not matter.
BridgeDecks find_decks(const BridgeMap& map, const place::LonLatToFrame& to_frame,
                       const place::HeightAt& height_at);

}  // namespace nightcity::bridges
