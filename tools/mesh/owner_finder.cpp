#include "tools/mesh/owner_finder.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "formats/finite.h"

namespace nightcity::mesh {

bool holds(std::span<const std::vector<glm::dvec2>> rings, const glm::dvec2& place) {
  bool inside = false;
  for (const auto& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const glm::dvec2 &a = ring[i], &b = ring[j];
      if ((a.y > place.y) != (b.y > place.y) &&
          place.x < (b.x - a.x) * (place.y - a.y) / (b.y - a.y) + a.x)
        inside = !inside;
    }
  return inside;
}

void OwnerFinder::Box::add(const glm::dvec2& p) {
  if (!finite(p)) return;
  low = glm::min(low, p);
  high = glm::max(high, p);
}

OwnerFinder::OwnerFinder(const PlaneLayer& layer) : layer_(layer), boxes_(layer.size()) {
  constexpr std::size_t max_side = 128;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    for (const auto& ring : layer[i].rings)
      for (const glm::dvec2& p : ring) boxes_[i].add(p);
    if (boxes_[i].is_empty()) continue;
    whole_.add(boxes_[i].low);
    whole_.add(boxes_[i].high);
  }
  if (whole_.is_empty()) return;
  side_ = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::sqrt(static_cast<double>(layer.size()))), 1, max_side);
  squares_.resize(side_ * side_);
  for (std::uint32_t i = 0; i < layer.size(); ++i) {
    if (boxes_[i].is_empty()) continue;
    const auto [first_column, first_row] = find_square(boxes_[i].low);
    const auto [last_column, last_row] = find_square(boxes_[i].high);
    for (std::size_t row = first_row; row <= last_row; ++row)
      for (std::size_t column = first_column; column <= last_column; ++column)
        squares_[row * side_ + column].push_back(i);
  }
}

std::uint32_t OwnerFinder::find(const glm::dvec2& place) const {
  if (!whole_.holds(place)) return no_label;
  const auto [column, row] = find_square(place);
  for (const std::uint32_t i : squares_[row * side_ + column])
    if (boxes_[i].holds(place) && mesh::holds(layer_[i].rings, place)) return layer_[i].label;
  return no_label;
}

std::pair<std::size_t, std::size_t> OwnerFinder::find_square(const glm::dvec2& place) const {
  const auto along = [&](double value, double low, double high) {
    const double share = high > low ? (value - low) / (high - low) : 0;
    return std::min(static_cast<std::size_t>(share * static_cast<double>(side_)), side_ - 1);
  };
  return {along(place.x, whole_.low.x, whole_.high.x), along(place.y, whole_.low.y, whole_.high.y)};
}

}  // namespace nightcity::mesh
