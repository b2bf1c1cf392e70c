// Lays out street lamps where the map has streets but no lamps, as towns do: by the street's width,
// the mounting height and the light that the street's class asks for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/layout/road_illuminance.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::layout {

struct LayoutOptions {
  enum class Mode {
    automatic,  // where no mapped lamp stands within 1.5 spacings on the same street
    never,
    always  // everywhere; mapped lamps are not used
  };
  Mode mode = Mode::automatic;
  // Highway value and EN 13201-2 class ("M4", "P3") that replaces the table's. The caller
  // has checked them.
  std::map<std::string, std::string> class_of;
};

/// One stretch between junctions. Illuminances are those of the new scene: with new luminaires and
/// every lamp within five mounting heights, mapped ones too, without obstacles.
struct StreetReport {
  std::string highway, name, wanted;  // wanted: EN 13201-2 class
  std::vector<std::int64_t> ways;
  Arrangement arrangement = Arrangement::single;
  double length_m = 0, width_m = 0;  // of the part in the model
  double spacing_m = 0, flux_lm = 0, mounting_m = 0;
  std::size_t lamps = 0;
  double wanted_lx = 0;
  FieldSummary field;
};

/// All streets of one class of road.
struct RoadClassReport {
  std::string wanted;
  double wanted_lx = 0;
  double length_m = 0;
  std::size_t streets = 0, lamps = 0;
  double average_lx = 0;              // over the area of all streets
  double min_lx = 0, uniformity = 0;  // medians of the streets at least one spacing long
  double in_class = 0;  // share of the length whose maintained average lies within its class
};

struct LayoutReport {
  std::vector<StreetReport> streets;
  std::map<std::string, RoadClassReport> classes;   // by highway
  std::map<std::string, std::size_t> unlit_ways;    // in the model but not to be lit, by reason
  std::map<std::string, std::size_t> left_out;      // places that get no lamp, by reason
  std::map<std::string, std::size_t> notes;         // lamps moved, tags of ways not read
  std::map<std::string, std::size_t> arrangements;  // lamps by arrangement
  std::size_t lamps = 0;
};

/// Appends lamps to `set`, which holds the mapped ones. The identity of a lamp follows from its way
/// and its place along the way, so it does not depend on the rest of the map. Its flux has
/// ValueSource::standard, its other values have ValueSource::rule. Mode::never adds nothing.
LayoutReport lay_out_lamps(const osm::OsmData& osm, const place::LonLatToFrame& to_frame,
                           const place::HeightAt& height_at, const place::InsideBuilding& inside,
                           const lights::LampOptions& lamps, const LayoutOptions& options,
                           lights::LampSet& set);

}  // namespace nightcity::layout
