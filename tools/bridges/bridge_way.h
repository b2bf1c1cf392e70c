// The ways of a map that bridges carry, and what their tags say about them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "tools/bridges/deck_profile.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::bridges {

enum class Carried : std::uint8_t { street, path, rail };
const char* name_of(Carried kind);

/// Thickness of a deck, m: a beam's span over 20 for a span of 16 m, an assumption.
constexpr double deck_m = 0.8;

/// The rules of a kind of way for a bridge that carries it, and for one that it passes below.
struct CarriedKind {
  DeckRules rules;
  double clear_m;        // height of what passes below a bridge
  double least_clear_m;  // below which nothing passes
};
/// Returns the rules of a kind; `electric`: a railway with a contact line above it.
CarriedKind find_kind(Carried kind, bool electric = false);

/// Returns what a way with these tags carries; none where it is no street, path or track that lies
/// in the open.
std::optional<Carried> find_carried(const osm::OsmTags& tags);
/// Returns whether a way leaves the ground: boardwalks and fords do not.
bool is_bridge(const osm::OsmTags& tags);
/// Returns the tag `layer` from -5 to 5, else 1 of bridges and 0 of others.
int read_layer(const osm::OsmTags& tags);
/// Returns half the width of a deck that carries a way, m: the way with its pavements, and beyond
/// them a cap that holds the railing.
double find_half_width_m(const osm::OsmTags& tags, Carried kind);

/// A node of the map, by its coordinates in the map's own resolution.
using NodeKey = std::pair<std::int64_t, std::int64_t>;
NodeKey to_key(const glm::dvec2& lon_lat);

/// A way in the city's frame, without points that have no place in it or lie on the one before.
struct PlacedWay {
  const osm::OsmWay* way = nullptr;
  Carried kind = Carried::street;
  int layer = 0;
  double half_m = 0;
  std::vector<glm::dvec2> line;     // E, N, m
  std::vector<glm::dvec2> lon_lat;  // of the same points
};
PlacedWay place_way(const osm::OsmWay& way, Carried kind, const place::LonLatToFrame& to_frame);

}  // namespace nightcity::bridges
