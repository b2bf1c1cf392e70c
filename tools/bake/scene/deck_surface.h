// The surfaces of bridges' decks, without what covers them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/bridges/bridge_decks.h"

namespace nightcity::bake {

/// The top of the decks of a layer that lie side by side, as one surface.
struct DeckSurface {
  std::vector<glm::dvec3> points;                       // E, N, H, m
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise in plan
  struct Edge {
    std::uint32_t from, to;  // the surface lies to the left
    bool is_end;             // at an end of a deck: people and vehicles pass here
  };
  std::vector<Edge> edges;  // of its outline
};

/// Returns the surfaces of all decks of a layer. Throws Error where outlines cross too often.
std::vector<DeckSurface> make_deck_surfaces(const bridges::BridgeDecks& decks, int layer);

}  // namespace nightcity::bake
