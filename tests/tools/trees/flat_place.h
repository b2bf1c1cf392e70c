// A place for trees: degrees stand for metres, and the ground lies at 5 m within 500 m.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/ground_cover/cover.h"
#include "tools/place/site.h"

namespace nightcity::trees {

inline const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
inline const place::HeightAt ground = [](const glm::dvec2& p) {
  return std::max(std::abs(p.x), std::abs(p.y)) <= 500 ? std::optional(5.0) : std::nullopt;
};
constexpr ground_cover::Box bounds{{-500, -500}, {500, 500}};

}  // namespace nightcity::trees
