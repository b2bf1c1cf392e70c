#include "tools/ground_cover/cover.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "formats/finite.h"
#include "tools/ground_cover/clip_ring.h"
#include "tools/roads/road_class.h"

namespace nightcity::ground_cover {
namespace {

// Outlines lie on a grid of about a millimetre: corners that are meant to be one are one then.
constexpr double steps_a_metre = 1024;

// Rounds a place to the grid, and outward on a side of the box: between an outline and the side a
// strip of bare ground would stand up from a carriageway.
glm::dvec2 round_outward(const glm::dvec2& p, const Box& box) {
  glm::dvec2 rounded = glm::round(p * steps_a_metre);
  for (int axis = 0; axis < 2; ++axis) {
    if (p[axis] == box.low[axis]) rounded[axis] = std::floor(p[axis] * steps_a_metre);
    if (p[axis] == box.high[axis]) rounded[axis] = std::ceil(p[axis] * steps_a_metre);
  }
  return rounded / steps_a_metre;
}

std::vector<std::vector<glm::dvec2>> to_part(const std::vector<std::vector<glm::dvec2>>& rings,
                                             const Box& box, const glm::dvec2& origin) {
  std::vector<std::vector<glm::dvec2>> out;
  for (const auto& ring : rings) {
    std::vector<glm::dvec2> cut = clip_ring(ring, box.low, box.high);
    for (glm::dvec2& p : cut) p = round_outward(p, box) - origin;
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
    if (cut.size() >= 3) out.push_back(std::move(cut));
  }
  return out;
}

}  // namespace

void Cover::finish() {
  const auto is_bad = [](const std::vector<glm::dvec2>& ring) {
    // No city lies beyond the limit, and the index ends there.
    return ring.size() < 3 || std::any_of(ring.begin(), ring.end(), [](const glm::dvec2& p) {
             return !finite(p) || std::max(std::abs(p.x), std::abs(p.y)) > 1e8;
           });
  };
  for (CoverArea& area : areas_) std::erase_if(area.rings, is_bad);
  const std::size_t bad =
      std::erase_if(areas_, [](const auto& area) { return area.rings.empty(); });
  if (bad > 0) left_out["area without a finite outline"] += bad;
  std::erase_if(markings_, [&](const MarkingRing& marking) { return is_bad(marking.ring); });
  std::stable_sort(markings_.begin(), markings_.end(),
                   [](const auto& a, const auto& b) { return a.kind < b.kind; });
  std::stable_sort(areas_.begin(), areas_.end(),
                   [](const CoverArea& a, const CoverArea& b) { return a.rank > b.rank; });
  const auto last_sunken =
      std::find_if(areas_.rbegin(), areas_.rend(), [](const auto& a) { return a.surface.sunken; });
  const auto deciding = static_cast<std::uint32_t>(areas_.rend() - last_sunken);
  std::map<Surface, std::uint32_t> known;
  for (std::uint32_t i = 0; i < areas_.size(); ++i) {
    const auto [label, is_new] =
        known.try_emplace(areas_[i].surface, static_cast<std::uint32_t>(surfaces_.size()));
    if (is_new) surfaces_.push_back(areas_[i].surface);
    labels_.push_back(label->second);
    boxes_.push_back(find_box(areas_[i].rings));
    area_index_.add(i, boxes_.back());
    if (i < deciding) depth_index_.add(i, boxes_.back());
  }
  const auto share_of = [&](std::uint32_t i, const Box& box) {
    return find_share(areas_[i].rings, box);
  };
  const auto count_corners = [&](std::uint32_t i) {
    std::size_t corners = 0;
    for (const Ring& ring : areas_[i].rings) corners += ring.size();
    return corners;
  };
  area_index_.split_crowded(share_of, count_corners);
  depth_index_.split_crowded(share_of, count_corners);
  for (std::uint32_t i = 0; i < markings_.size(); ++i)
    marking_index_.add(i, find_box({markings_[i].ring}));
  std::erase_if(ramps_, [&](const RampFacet& facet) { return is_bad(facet.ring); });
  for (std::uint32_t i = 0; i < ramps_.size(); ++i) ramp_index_.add(i, find_box({ramps_[i].ring}));
}

CoverPart Cover::find_part(const Box& box, const glm::dvec2& origin) const {
  CoverPart part;
  for (const std::uint32_t i : area_index_.find(box))
    if (auto rings = to_part(areas_[i].rings, box, origin); !rings.empty())
      part.areas.push_back({std::move(rings), labels_[i]});
  for (const std::uint32_t i : marking_index_.find(box))
    if (auto rings = to_part({markings_[i].ring}, box, origin); !rings.empty())
      part.markings.push_back({std::move(rings), static_cast<std::uint32_t>(markings_[i].kind)});
  for (const std::uint32_t i : ramp_index_.find(box))
    if (auto rings = to_part({ramps_[i].ring}, box, origin); !rings.empty())
      part.ramps.push_back({std::move(rings), i});
  return part;
}

const CoverArea* Cover::find_first(const BoxIndex& index, const glm::dvec2& place) const {
  if (!finite(place)) return nullptr;
  const std::uint32_t first = index.find_first(place, [&](std::uint32_t i) {
    return boxes_[i].holds(place) && mesh::holds(areas_[i].rings, place);
  });
  return first == BoxIndex::none ? nullptr : &areas_[first];
}

double Cover::depth_at(const glm::dvec2& place) const {
  const CoverArea* area = find_first(depth_index_, place);
  return area && area->surface.sunken ? roads::kerb_m : find_lowering_m(place);
}

double Cover::find_lowering_m(const glm::dvec2& place) const {
  if (!finite(place)) return 0;
  const std::uint32_t first = ramp_index_.find_first(place, [&](std::uint32_t i) {
    return mesh::holds({&ramps_[i].ring, 1}, place);
  });
  return first == BoxIndex::none ? 0 : ramps_[first].find_lowering_m(place);
}

const Surface* Cover::surface_at(const glm::dvec2& place) const {
  const CoverArea* area = find_first(area_index_, place);
  return area ? &area->surface : nullptr;
}

}  // namespace nightcity::ground_cover
