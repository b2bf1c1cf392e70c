#include "tools/lights/window_groups.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/random.h"

namespace nightcity::lights {
namespace {

constexpr double same_plane_m = 0.05, same_storey_m = 0.5;
constexpr float same_direction = 0.9999f;  // cosine of 0.8 degrees
constexpr std::int64_t draw_purpose = 7;   // of the random stream that draws a group's hours

}  // namespace

WindowGrouper::Extent WindowGrouper::extent_of(const LitRectangle& window) const {
  const glm::dvec3 along(first_.along), up = glm::cross(glm::dvec3(first_.normal), along);
  const glm::dvec3 place = window.centre - first_.centre;
  const double u = glm::dot(place, along), v = glm::dot(place, up);
  const double half_width = double{window.half_width}, half_height = double{window.half_height};
  return {u - half_width, u + half_width, v - half_height, v + half_height};
}

bool WindowGrouper::lies_in_wall(const LitRectangle& window) const {
  return !groups_.empty() && window.provenance.source_id == first_.provenance.source_id &&
         glm::dot(window.normal, first_.normal) > same_direction &&
         glm::dot(window.along, first_.along) > same_direction &&
         std::abs(glm::dot(window.centre - first_.centre, glm::dvec3(first_.normal))) <
             same_plane_m;
}

bool WindowGrouper::fits(const Group& group, const Extent& extent) const {
  const double left = std::min(group.extent.left, extent.left),
               right = std::max(group.extent.right, extent.right),
               bottom = std::min(group.extent.bottom, extent.bottom),
               top = std::max(group.extent.top, extent.top);
  if (right - left > max_window_group_m || top - bottom > max_window_group_m) return false;
  return grouping_ == WindowGrouping::facade ||
         std::abs(group.extent.bottom + group.extent.top - extent.bottom - extent.top) <
             2 * same_storey_m;
}

void WindowGrouper::add(const LitRectangle& window) {
  if (grouping_ == WindowGrouping::none) {
    ++emitters_;
    return sink_(window);
  }
  if (!lies_in_wall(window)) {
    finish();
    first_ = window;
  }
  const Extent extent = extent_of(window);
  const auto group = std::find_if(groups_.begin(), groups_.end(),
                                  [&](const Group& each) { return fits(each, extent); });
  if (group == groups_.end()) {
    groups_.push_back({{window}, extent});
    return;
  }
  group->windows.push_back(window);
  group->extent = {
      std::min(group->extent.left, extent.left), std::max(group->extent.right, extent.right),
      std::min(group->extent.bottom, extent.bottom), std::max(group->extent.top, extent.top)};
}

void WindowGrouper::pass_on(const Group& group) {
  ++emitters_;
  if (group.windows.size() == 1) return sink_(group.windows.front());
  double flux = 0, flux_cct = 0;
  std::uint64_t name = 0;
  for (const LitRectangle& window : group.windows) {
    flux += window.flux_lm();
    flux_cct += window.flux_lm() * double{window.cct_k};
    name = mix(name ^ window.id);
  }
  Random random{draw_purpose, static_cast<std::int64_t>(name)};
  double left = flux * random.uniform();
  const LitRectangle* drawn = &group.windows.back();
  for (const LitRectangle& window : group.windows) {
    left -= window.flux_lm();
    if (left < 0) {
      drawn = &window;
      break;
    }
  }
  LitRectangle all = *drawn;
  const glm::dvec3 along(first_.along), up = glm::cross(glm::dvec3(first_.normal), along);
  const Extent& e = group.extent;
  all.centre = first_.centre + along * (0.5 * (e.left + e.right)) + up * (0.5 * (e.bottom + e.top));
  all.normal = first_.normal;
  all.along = first_.along;
  all.half_width = static_cast<float>(0.5 * (e.right - e.left));
  all.half_height = static_cast<float>(0.5 * (e.top - e.bottom));
  all.luminance_cd_m2 *= static_cast<float>(flux / all.flux_lm());
  all.cct_k = static_cast<float>(flux_cct / flux);
  all.provenance.position = all.provenance.height = ValueSource::rule;
  sink_(all);
}

void WindowGrouper::finish() {
  for (const Group& group : groups_) pass_on(group);
  groups_.clear();
}

}  // namespace nightcity::lights
