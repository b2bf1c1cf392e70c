#include "tools/map_lights/light_collector.h"

#include <utility>

#include "formats/colour.h"
#include "tools/random.h"

namespace nightcity::map_lights {

bool LightCollector::add(const LitThing& thing, Installation plan, double maintained_lx,
                         double radius_m) {
  if (!reach_mean(plan.lamps, plan.profile, plan.points, maintained_lx)) return false;
  const std::uint32_t profile = profiles_.add(plan.beam, plan.profile);
  for (lights::PlacedLamp& lamp : plan.lamps) {
    lamp.cct_k = thing.cct_k;
    lamp.colour = rec709_from_xy(planckian_xy(thing.cct_k));
    lamp.radius_m = radius_m;
    lamp.profile = profile;
    lamp.hours = thing.hours.night;
    lamp.id = make_id(thing);
    lamp.provenance = make_provenance(thing);
    lamp.provenance.flux = ValueSource::standard;
    count(thing, lamp.provenance, lamp.flux_lm);
    set_.luminaires.push_back(std::move(lamp));
  }
  return true;
}

void LightCollector::add(const LitThing& thing, lights::LitRectangle face, ValueSource flux) {
  face.cct_k = static_cast<float>(thing.cct_k);
  face.hours = thing.hours.night;
  face.id = make_id(thing);
  face.provenance = make_provenance(thing);
  face.provenance.flux = flux;
  count(thing, face.provenance, face.flux_lm());
  set_.signs.push_back(face);
}

MapLightSet LightCollector::take() && {
  set_.profiles = std::move(profiles_.profiles);
  set_.profile_data = std::move(profiles_.data);
  return std::move(set_);
}

LightProvenance LightCollector::make_provenance(const LitThing& thing) const {
  LightProvenance from;
  from.source_id = static_cast<std::uint64_t>(thing.source.id);
  from.position = thing.position;
  from.height = thing.height;
  from.colour = from.profile = ValueSource::rule;
  from.schedule = thing.hours.source;
  from.family = static_cast<std::uint8_t>(LightFamily::other);
  return from;
}

void LightCollector::count(const LitThing& thing, const LightProvenance& from, double flux_lm) {
  MapLightReport::Kind& kind = set_.report.kinds[static_cast<std::size_t>(thing.kind)];
  ++kind.lights;
  kind.flux_lm += flux_lm;
  lights::count_hours(thing.hours.night, kind.hours);
  auto& sources = set_.report.sources;
  ++sources["position"][nightcity::name_of(from.position)];
  ++sources["height"][nightcity::name_of(from.height)];
  ++sources["flux"][nightcity::name_of(from.flux)];
  ++sources["hours"][nightcity::name_of(from.schedule)];
}

// The same light has the same id after every bake. Nodes and ways are numbered apart.
std::uint32_t LightCollector::make_id(const LitThing& thing) {
  std::uint64_t key = hash_text(thing.source.is_way ? "shining way" : "shining node");
  key = mix(key ^ static_cast<std::uint64_t>(thing.source.id));
  while (true) {
    key = mix(key);
    const auto id = static_cast<std::uint32_t>(key >> 32);
    if (id != 0xFFFFFFFFu && ids_.insert(id).second) return id;
  }
}

}  // namespace nightcity::map_lights
