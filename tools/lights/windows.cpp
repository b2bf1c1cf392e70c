#include "tools/lights/windows.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/rgb9e5.h"
#include "tools/lights/colour.h"

namespace nightcity {
namespace {

constexpr double before_wall_m = 0.02;
constexpr double above_ground_m = 0.3;

/// Windows of one household lie side by side on one storey; a small house is one household.
std::int64_t household_of(const WindowPlace& place, bool one_family, std::uint64_t building) {
  if (one_family) return 0;
  // Flats of two to four bays: cuts wherever the bay's hash says so.
  std::int64_t run = 0;
  for (int bay = 1, length = 1; bay <= place.bay; ++bay, ++length) {
    const std::uint64_t hash =
        mix(building ^ (static_cast<std::uint64_t>(place.facade) << 32 | static_cast<std::uint64_t>(bay)));
    if (length >= 4 || (length >= 2 && hash % 2 == 0)) ++run, length = 0;
  }
  return 1 + (static_cast<std::int64_t>(place.facade) << 40 | static_cast<std::int64_t>(place.storey) << 20 |
              run);
}

}  // namespace

double LitRectangle::flux_lm() const {
  return std::numbers::pi * luminance_cd_m2 * 4.0 * half_width * half_height;
}

WindowLayout::WindowLayout(const WindowOptions& options) : options_(options) {}

void WindowLayout::add(const CityObject& building) {
  if (building.type != ObjectType::building) return;
  walls_.add(building);
  const KnownUse use = use_of(building);
  ++set_.sources["use"][std::string(name_of(use.use)) + (use.stated ? ", stated" : ", assumed")];
  light(building, lay_windows(building, use.use, options_.seed, facades_), use);
}

void WindowLayout::light(const CityObject& building, const std::vector<WindowPlace>& places, KnownUse use) {
  const std::uint64_t name = hash_text(building.id);
  std::uint16_t top = 0;
  for (const WindowPlace& place : places) top = std::max(top, place.storey);
  const bool one_family = use.use == BuildingUse::residential && top < 2 && places.size() < 40;
  for (const WindowPlace& place : places) {
    const auto seed = static_cast<std::int64_t>(options_.seed), key = static_cast<std::int64_t>(name);
    Random people{seed, key, household_of(place, one_family, name)};
    const Household household = draw_household(use.use, people);
    const std::int64_t spot = static_cast<std::int64_t>(place.facade) << 32 |
                              static_cast<std::int64_t>(place.storey) << 16 | place.bay;
    Random random{seed, key, spot, 1 + place.modelled};
    const LitWindow lit = draw_window(household, place.kind, random);
    if (lit.schedule.never()) {
      ++set_.dropped["dark all night"];
      continue;
    }
    LitRectangle window;
    window.centre = place.centre + place.normal * before_wall_m;
    window.normal = glm::vec3(place.normal);
    window.along = glm::vec3(place.along);
    window.half_width = static_cast<float>(place.half_width);
    window.half_height = static_cast<float>(place.half_height);
    window.luminance_cd_m2 = static_cast<float>(lit.luminance_cd_m2);
    window.cct_k = static_cast<float>(lit.cct_k);
    std::uint64_t id = mix(name ^ static_cast<std::uint64_t>(spot));
    while (static_cast<std::uint32_t>(id) == 0xFFFFFFFFu ||
           !ids_.insert(static_cast<std::uint32_t>(id)).second)
      id = mix(id);
    window.id = static_cast<std::uint32_t>(id);
    window.provenance.source_id = name;
    window.provenance.position = place.modelled ? ValueSource::attribute : ValueSource::rule;
    window.provenance.height = window.provenance.position;
    window.provenance.flux = window.provenance.colour = window.provenance.profile = ValueSource::rule;
    window.provenance.schedule = ValueSource::rule;
    window.provenance.family = static_cast<std::uint8_t>(LightFamily::window);
    set_.windows.push_back(window);
    schedule_of_.push_back(lit.schedule);
  }
}

bool WindowLayout::clear(const LitRectangle& window) const {
  const glm::dvec3 normal(window.normal),
      along = glm::dvec3(window.along) * static_cast<double>(window.half_width);
  const glm::dvec3 up =
      glm::cross(normal, glm::dvec3(window.along)) * static_cast<double>(window.half_height);
  const glm::dvec3 on_wall = window.centre - normal * before_wall_m;
  for (const double x : {0.0, -0.95, 0.95})
    for (const double y : {0.0, -0.95, 0.95})
      if (walls_.blocked(on_wall + along * x + up * y, normal, options_.obstacle_m)) return false;
  return true;
}

WindowSet WindowLayout::finish(const HeightAt& ground) && {
  std::size_t kept = 0;
  for (std::size_t n = 0; n < set_.windows.size(); ++n) {
    const LitRectangle& window = set_.windows[n];
    const glm::dvec3 before = window.centre + glm::dvec3(window.normal) * 0.3;
    const auto height = ground ? ground(glm::dvec2(before)) : std::nullopt;
    if (height && window.centre.z - static_cast<double>(window.half_height) < *height + above_ground_m) {
      ++set_.dropped["below the ground"];
    } else if (!clear(window)) {
      ++set_.dropped["something before it"];
    } else {
      ++set_.sources["position"][window.provenance.position == ValueSource::attribute ? "attribute" : "rule"];
      schedule_of_[kept] = schedule_of_[n];
      set_.windows[kept++] = set_.windows[n];
    }
  }
  set_.windows.resize(kept);
  schedule_of_.resize(kept);

  set_.schedules = schedule_of_;
  std::sort(set_.schedules.begin(), set_.schedules.end());
  set_.schedules.erase(std::unique(set_.schedules.begin(), set_.schedules.end()), set_.schedules.end());
  for (std::size_t n = 0; n < kept; ++n)
    set_.windows[n].schedule = static_cast<std::uint32_t>(
        std::lower_bound(set_.schedules.begin(), set_.schedules.end(), schedule_of_[n]) -
        set_.schedules.begin());
  set_.sources["storeys"]["attribute"] = facades_.storeys_from_attribute;
  set_.sources["storeys"]["rule"] = facades_.storeys_from_height;
  return std::move(set_);
}

Light to_light(const LitRectangle& window, const Georeference& georeference) {
  const auto turned = [](const glm::vec3& v) { return glm::normalize(glm::vec3(v.x, v.z, -v.y)); };
  Light light{};
  light.position = glm::vec3(georeference.to_model(window.centre));
  light.axis = turned(window.normal);
  light.tangent = turned(window.along);
  light.radius = window.half_width;
  light.half_height = window.half_height;
  light.flux_lm = static_cast<float>(window.flux_lm());
  light.colour_rgb9e5 = encode_rgb9e5(rec709_from_xy(planckian_xy(static_cast<double>(window.cct_k))));
  light.kind_profile = LIGHT_RECTANGLE | LIGHT_NO_PROFILE << 8;
  light.schedule = LIGHT_ALWAYS_ON;
  light.id = window.id;
  return light;
}

}  // namespace nightcity
