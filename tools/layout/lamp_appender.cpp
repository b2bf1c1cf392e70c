#include "tools/layout/lamp_appender.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/layout/layout_fit.h"
#include "formats/colour.h"
#include "tools/lights/optics.h"
#include "tools/random.h"

namespace nightcity::layout {

LampAppender::LampAppender(const lights::LampOptions& lamps, lights::LampSet& set)
    : options_(lamps), set_(set), first_(set.lamps.size()) {
  for (std::uint32_t n = 0; n < first_; ++n) {
    ids_.insert(set.lamps[n].id);
    placed_.add(glm::dvec2(set.lamps[n].foot), n);
  }
}

void LampAppender::set_hours(std::int64_t way_id, const lights::NightSchedule& hours) {
  hours_of_way_.emplace(way_id, hours);
}

bool LampAppender::any_near(const glm::dvec2& p, double radius) const {
  return placed_.any_near(p, radius, [](const glm::dvec2&, std::uint32_t) { return true; });
}

bool LampAppender::lit_by_another(std::size_t number, const glm::dvec2& p, double radius) const {
  return placed_.any_near(p, radius, [&](const glm::dvec2& foot, std::uint32_t n) {
    const bool is_own = n >= first_ && street_of_lamp_[n - first_] == number;
    return !is_own && glm::dot(p - foot, set_.lamps[n].aim) > 0;
  });
}

const lights::LuminaireChoice* LampAppender::find_measured(const lights::RoadLighting& road,
                                                           bool is_hung) const {
  return is_hung || road.optic == lights::Optic::lantern ? nullptr
                                                         : lights::luminaire_for(options_, road);
}

std::uint32_t LampAppender::profile_for(const lights::RoadLighting& road, bool is_hung) {
  const lights::LuminaireChoice* choice = find_measured(road, is_hung);
  const lights::Optic optic = is_hung ? lights::Optic::central : road.optic;
  const std::string name = choice ? choice->name : lights::name_of(optic);
  const auto known = profiles_.find(name);
  if (known != profiles_.end()) return known->second;
  return profiles_[name] =
             add_profile(set_, choice ? choice->photometry : lights::make_optic(optic));
}

std::uint32_t LampAppender::make_unused_id(const streets::Street::Place& place, int side) {
  for (std::int64_t attempt = 0;; ++attempt) {
    Random random{place.way_id, std::llround(place.on_way_m * 10), side, attempt};
    const auto id = static_cast<std::uint32_t>(random.next() >> 32);
    if (id != 0xFFFFFFFFu && ids_.insert(id).second) return id;
  }
}

void LampAppender::append(std::size_t number, const streets::Street& street,
                          const LampDesign& design, const PostSite& site) {
  const lights::RoadLighting& road = lighting_of(street);
  const streets::Street::Place place = street.place(site.along_m);
  const glm::dvec2 left(-place.along.y, place.along.x);
  lights::PlacedLamp lamp;
  lamp.foot = site.foot;
  lamp.mounting_height_m = road.mounting_m;
  lamp.hung = site.side == 0;
  lamp.aim = left * (site.side > 0 ? -1.0 : 1.0);
  if (!lamp.hung) lamp.outreach = lamp.aim * std::min(road.outreach_m, site.offset_m);
  lamp.flux_lm = design.flux_lm;
  lamp.cct_k = road.cct_k;
  lamp.colour = rec709_from_xy(planckian_xy(road.cct_k));
  lamp.radius_m = road.optic == lights::Optic::lantern && !lamp.hung ? lights::lantern_radius_m
                                                                     : lights::luminous_radius_m;
  lamp.profile = profile_for(road, lamp.hung);
  lamp.highway = road.highway;
  lamp.way_id = place.way_id;
  lamp.along_m = place.on_way_m;
  lamp.id = make_unused_id(place, site.side);
  lamp.provenance.source_id = static_cast<std::uint64_t>(place.way_id);
  lamp.provenance.position = lamp.provenance.height = lamp.provenance.colour =
      lamp.provenance.schedule = ValueSource::rule;
  if (const auto hours = hours_of_way_.find(lamp.way_id); hours != hours_of_way_.end()) {
    lamp.hours = hours->second;
    lamp.provenance.schedule = ValueSource::tag;
  }
  lamp.provenance.flux = ValueSource::standard;
  lamp.provenance.profile =
      find_measured(road, lamp.hung) ? ValueSource::attribute : ValueSource::rule;
  lamp.provenance.family = static_cast<std::uint8_t>(LightFamily::lamp);
  placed_.add(glm::dvec2(site.foot), static_cast<std::uint32_t>(set_.lamps.size()));
  street_of_lamp_.push_back(number);
  set_.lamps.push_back(lamp);
}

void LampAppender::count_sources() const {
  for (std::size_t n = first_; n < set_.lamps.size(); ++n) {
    const lights::PlacedLamp& lamp = set_.lamps[n];
    for (const char* value : {"position", "height", "colour"}) ++set_.sources[value]["rule"];
    ++set_.sources["flux"]["standard"];
    ++set_.sources["profile"][lamp.provenance.profile == ValueSource::rule ? "rule" : "attribute"];
    ++set_.sources["aim"]["layout"];
    ++set_.sources["road class"][std::string(lamp.highway)];
  }
}

}  // namespace nightcity::layout
