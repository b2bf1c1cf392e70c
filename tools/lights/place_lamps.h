// Street lamps: from OSM nodes and the roads beside them to luminaires with flux, colour, height and aim.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/light_file.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/night_schedule.h"
#include "tools/lights/photometry.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity {

/// One lamp post with its luminaires placed, in the frame's E, N, H metres.
struct PlacedLamp {
  glm::dvec3 foot{0};            // where the post meets the ground
  double mounting_height_m = 0;  // luminous centre above the foot
  glm::dvec2 outreach{0, 0};     // from the post to the luminous centre, horizontal, m
  glm::dvec2 aim{0, 1};          // unit, horizontal: towards the road (the C = 0 half-plane)
  bool hung = false;             // on a wire between facades: no post
  double tilt_degrees = 0;       // of the luminaire's axis, from straight down towards `aim`
  double flux_lm = 0;
  double cct_k = 0;
  glm::vec3 colour{1};  // linear Rec. 709, luminance 1
  double radius_m = 0;  // luminous radius
  std::uint32_t profile = LIGHT_NO_PROFILE;
  std::optional<NightSchedule> hours;  // none: always on
  std::string_view highway;  // of the road it lights, "" = none; from the table of defaults
  std::int64_t way_id = 0;   // that road, and how far along it
  double along_m = 0;
  std::uint32_t id = 0;
  LightProvenance provenance;
};

struct LampSet {
  std::vector<PlacedLamp> lamps;
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  std::map<std::string, std::size_t>
      dropped;  // reason and count: "outside the model", "duplicate", "lit=no", ...
  std::map<std::string, std::map<std::string, std::size_t>>
      sources;                               // value name, source, count: for the report
  std::map<std::string, std::size_t> notes;  // what was mended or could not be read, and how often
};

/// A measured luminaire for the lamps of some roads, instead of the analytic optics.
struct LuminaireChoice {
  std::string name;                   // of its file: stored once
  Photometry photometry;              // C = 0 towards the street
  std::vector<std::string> highways;  // OSM classes it serves; empty = every road
  std::vector<LampType> types;        // lamps it serves; empty = every type
  bool take_flux = true;              // the luminaire's lumens too, where no tag gives them
  double flux_lm = 0;
};

struct LampOptions {
  std::vector<LuminaireChoice>
      luminaires;  // the first that serves a road wins; lanterns and floodlights stay
  bool heights_from_tags = false;  // a lamp's tag ele, where it has one, wins over the ground
};

/// The measured luminaire for a lamp of that type beside a road, or none. Lamps of unknown type are LED.
const LuminaireChoice* luminaire_for(const LampOptions& options, const RoadLighting& road,
                                     LampType type = LampType::led);

/// Every value a tag gives is taken; the rest comes from the road beside and the table of defaults
/// (lamp_defaults.h). A lamp that stands inside a building (where `inside` is given and says so) is moved out
/// towards its road.
LampSet place_lamps(const OsmData& osm, const LonLatToFrame& to_frame, const HeightAt& height_at,
                    const InsideBuilding& inside = {}, const LampOptions& options = {});

/// The luminaire as a light of model space; its hours go into `schedules`.
Light to_light(const PlacedLamp& lamp, const Georeference& georeference, ScheduleTable& schedules);

}  // namespace nightcity
