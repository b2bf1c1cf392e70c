// Places the street lamps of a map: from OSM nodes and the roads beside them to luminaires with
// flux, colour, height and aim.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "formats/light_file.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/photometry.h"
#include "tools/lights/placed_lamp.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::lights {

struct LampSet {
  std::vector<PlacedLamp> lamps;
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  // Number of lamps left out, by reason: "outside the model", "duplicate", "lit=no", ...
  std::map<std::string, std::size_t> left_out;
  // Name of a value, its source, number of lamps: for the report.
  std::map<std::string, std::map<std::string, std::size_t>> sources;
  // Number of values that were repaired or could not be read, by kind.
  std::map<std::string, std::size_t> notes;
};

/// A measured luminaire for the lamps of some roads, instead of the analytic optics.
struct LuminaireChoice {
  std::string name;                   // of its file; equal names are stored once
  Photometry photometry;              // C = 0 towards the street
  std::vector<std::string> highways;  // OSM classes that it serves; empty: every road
  std::vector<LampType> types;        // types of lamp that it serves; empty: every type
  bool take_flux = true;              // take the luminaire's flux too, where no tag gives one
  double flux_lm = 0;
  std::vector<std::string> models{};  // of luminaires that it is; empty: every one
};

struct LampOptions {
  // The first that serves a road wins. Lanterns and floodlights keep their analytic optics.
  std::vector<LuminaireChoice> luminaires;
  bool heights_from_tags =
      false;  // the tag `ele` of a lamp, where it has one, overrides the ground
};

/// Returns the measured luminaire for a lamp of this type beside a road, or null. Lamps of unknown
/// type count as LED. `model`: as an inventory names it.
const LuminaireChoice* luminaire_for(const LampOptions& options, const RoadLighting& road,
                                     LampType type = LampType::led, const std::string& model = {});

/// Places all lamps of a map. Values come from the tags; the rest comes from the road beside a lamp
/// and the table of defaults (lamp_defaults.h). A lamp that stands inside a building, as far as
/// `inside` is given, is moved out towards its road. Lamps outside the model, where `height_at` is
/// empty, are left out and counted.
LampSet place_lamps(const osm::OsmData& osm, const place::LonLatToFrame& to_frame,
                    const place::HeightAt& height_at, const place::InsideBuilding& inside = {},
                    const LampOptions& options = {});

}  // namespace nightcity::lights
