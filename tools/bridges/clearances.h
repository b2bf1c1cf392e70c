// The heights that a deck has to keep above a way that it crosses, everywhere where it covers it.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "tools/bridges/bridge_way.h"
#include "tools/bridges/chains.h"
#include "tools/bridges/crossed_ways.h"
#include "tools/bridges/deck_profile.h"

namespace nightcity::bridges {

/// Returns the height of what is crossed at a place; none where it has no ground.
using SurfaceAt = std::function<std::optional<double>(const glm::dvec2& place)>;

/// Returns stretches along a chain that crosses `way` at `crossing`, each with the height above the
/// highest place that the deck has below it there: across the whole width of the way and of the
/// deck. Ways that cross at a small angle are followed as far as the deck covers them, where it is
/// as high as its gradient allows.
std::vector<Clearance> find_clearances(const Chain& chain, const PlacedWay& way,
                                       const Crossing& crossing, const CarriedKind& below,
                                       const SurfaceAt& surface_at);

}  // namespace nightcity::bridges
