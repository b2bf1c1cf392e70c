// Collects the lights of all kinds: gives them ids and profiles, and counts them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>

#include "tools/map_lights/installation.h"
#include "tools/map_lights/place_map_lights.h"
#include "tools/map_lights/thing.h"

namespace nightcity::map_lights {

/// The thing whose lights are added, with what all of them share.
struct LitThing {
  const osm::OsmShiningThing& source;
  MapLightKind kind;
  Hours hours;
  double cct_k = 0;
  ValueSource position = ValueSource::rule, height = ValueSource::rule;
};

class LightCollector {
 public:
  /// Adds the luminaires of a plan with the flux that gives its points the mean. Returns whether
  /// that is possible.
  bool add(const LitThing& thing, Installation plan, double maintained_lx, double radius_m);
  /// Adds a face of a sign; its place and luminance are set.
  void add(const LitThing& thing, lights::LitRectangle face, ValueSource flux);
  void add(const Body& body) { set_.bodies.push_back(body); }

  MapLightReport& report() { return set_.report; }
  void leave_out(std::string_view reason) { ++set_.report.left_out[std::string(reason)]; }
  MapLightSet take() &&;

 private:
  LightProvenance make_provenance(const LitThing& thing) const;
  void count(const LitThing& thing, const LightProvenance& from, double flux_lm);
  std::uint32_t make_id(const LitThing& thing);

  MapLightSet set_;
  lights::ProfileTable profiles_;
  std::unordered_set<std::uint32_t> ids_;
};

}  // namespace nightcity::map_lights
